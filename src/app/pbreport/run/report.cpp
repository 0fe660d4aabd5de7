#include "app/pbreport/run/report.h"

#include <ostream>

#include "app/common/options.h"
#include "app/pbreport/run/options.h"
#include "app/pbreport/run/page.h"
#include "app/pbreport/run/summary_from_file.h"
#include "io/run/xdmf.h"

namespace pbmpi::app {

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
