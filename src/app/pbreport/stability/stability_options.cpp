#include "app/pbreport/stability/stability_options.h"

#include <sstream>

#include "app/common/options.h"
#include "core/error.h"

namespace pbmpi::app {
namespace {

namespace po = boost::program_options;

po::options_description visible_options() {
  po::options_description all("Options");
  add_scene_choice(all);
  add_output_options("a map of cases and settings; a click on a field shows its curves and its replay", all);
  all.add_options()                               //
      ("json", "print all as one JSON document")  //
      ("markdown", "print the map as a table instead");
  add_general_options("--json or --markdown", all);
  return all;
}

}  // namespace

std::string stability_report_help_text() {
  std::ostringstream text;
  text << "pbreport stability shows which settings hold the hard cases: the file of pbstudy stability. The "
          "word "
          "stability may be left out.\n\n"
       << "Usage: pbreport [stability] stability.h5 [options]\n\n"
       << visible_options();
  return text.str();
}

StabilityReportOptions parse_stability_report_options(const std::vector<std::string>& args) {
  const po::variables_map values = parse_study_report(args, visible_options());
  StabilityReportOptions options;
  static_cast<ReportOfStudyOptions&>(options) =
      report_of_study_options(values, "a study of stability", "stability.h5");
  if (options.help) return options;
  options.markdown = values.count("markdown") != 0;
  core::require_input(!options.json || !options.markdown, "--json and --markdown: print one of the two");
  return options;
}

}  // namespace pbmpi::app
