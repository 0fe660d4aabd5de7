#include "app/pbreport/run/report.h"

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <ostream>

#include "app/common/options.h"
#include "app/common/python_program.h"
#include "app/pbreport/run/options.h"
#include "app/pbreport/run/summary_from_file.h"
#include "core/system/descriptor.h"
#include "io/run/xdmf.h"

namespace pbmpi::app {
namespace {

struct Close {
  void operator()(std::FILE* file) const { std::fclose(file); }
};

/// An open file without a name, which programs that this program starts inherit.
using UnnamedFile = std::unique_ptr<std::FILE, Close>;

UnnamedFile stored(const std::string& text) {
  UnnamedFile file(std::tmpfile());
  if (!file || std::fputs(text.c_str(), file.get()) < 0 || std::fflush(file.get()) != 0)
    throw core::RunError("no temporary file for the page can be written: " + core::reason_of(errno));
  return file;
}

/// Writes the page of the run in `file` to `page`: plots and a 3D replay, by the Python package
/// src/app/reports.
core::ExitCode write_page(const std::string& file, const std::string& page, const RunSummary& summary) {
  const UnnamedFile numbers = stored(to_json(summary));
  const std::string path_of_numbers = "/dev/fd/" + std::to_string(fileno(numbers.get()));
  setenv("PBREPORT_VERSION", version_line("pbreport").c_str(), 1);
  return run_report_for(page, {"report", file, page, path_of_numbers});
}

}  // namespace

core::ExitCode run_report(const ReportOptions& options, std::ostream& out) {
  if (options.action == ReportAction::version) {
    out << version_line("pbreport") << "\n";
    return core::ExitCode::done;
  }
  const io::RunData run = io::read_run(options.file);
  const RunSummary summary = summary_from_file(run, options.file);
  if (options.html) {
    const core::ExitCode code = write_page(options.file, *options.html, summary);
    if (code != core::ExitCode::done) return code;
  }
  if (options.xdmf) io::write_xdmf(options.file, *options.xdmf);
  if (options.json) {
    out << to_json(summary);
  } else if (!options.quiet) {
    out << to_text(summary);
  }
  out.flush();
  if (!out) throw core::RunError("the summary cannot be written to standard output; is the disk full?");
  return core::ExitCode::done;
}

}  // namespace pbmpi::app
