#include "app/pbreport/run_report.h"

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <ostream>

#include "app/common/options.h"
#include "app/common/run_program.h"
#include "app/pbreport/python_report.h"
#include "app/pbreport/summary_from_file.h"
#include "core/system/descriptor.h"
#include "io/run/xdmf.h"

namespace pbmpi::app {

namespace po = boost::program_options;
using core::require_input;

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
  return run_report_for(page, {"report", file, page, path_of_numbers});
}

}  // namespace

po::options_description report_options_description() {
  po::options_description summary("The summary");
  summary.add_options()  //
      ("json", "print it as one JSON document, with the keys of 'pbmpi --report json'");

  po::options_description write("What to write");
  write.add_options()  //
      ("html", po::value<std::string>()->value_name("OUT"),
       "one self-contained page: plots and a 3D replay; it loads nothing from the network")  //
      ("xdmf", po::value<std::string>()->value_name("OUT"),
       "the XML sidecar that opens the run in ParaView; keep it beside FILE");

  po::options_description general("General");
  general.add_options()                 //
      ("help,h", "print this help")     //
      ("version", "print the version")  //
      ("quiet,q", "print nothing but errors and what --json asks for");

  po::options_description all;
  all.add(summary).add(write).add(general);
  return all;
}

ReportOptions parse_report_options(const std::vector<std::string>& args) {
  const po::variables_map values = parse_with_files(args, report_options_description());

  ReportOptions options;
  if (values.count("help") != 0) options.action = ReportAction::help;
  if (values.count("version") != 0) options.action = ReportAction::version;
  options.html = output_path(values, "html");
  options.xdmf = output_path(values, "xdmf");
  options.json = values.count("json") != 0;
  options.quiet = values.count("quiet") != 0;
  if (options.action != ReportAction::report) return options;
  require_input(values.count("file") != 0,
                "no file given; name the HDF5 file of a run, e.g. pbreport 100CrSk.h5");
  const auto files = given_files(values);
  require_input(files.size() == 1, "'" + files.back() + "' follows '" + files.front() +
                                       "': pbreport reads one file; see --help");
  options.file = files.front();
  return options;
}

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
  require_printed(out, "the summary");
  return core::ExitCode::done;
}

}  // namespace pbmpi::app
