#include "app/pbreport/run/options.h"

#include "app/common/options.h"
#include "core/error.h"

namespace pbmpi::app {

namespace po = boost::program_options;
using core::require_input;

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
      ("config", po::value<std::string>()->value_name("FILE"),
       "read options from FILE, one 'name = value' a line; the command line wins")  //
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

}  // namespace pbmpi::app
