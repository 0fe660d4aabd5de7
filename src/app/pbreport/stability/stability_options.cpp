#include "app/pbreport/stability/stability_options.h"

#include <sstream>

#include "app/common/options.h"

namespace pbmpi::app {
namespace {

namespace po = boost::program_options;

po::options_description visible_options() {
  po::options_description all("Options");
  add_scene_choice(all);
  add_output_options("a map of cases and settings; a click on a field shows its curves and its replay", all);
  add_print_options("print the map as a table instead", all);
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

ReportOfStudyOptions parse_stability_report_options(const std::vector<std::string>& args) {
  return report_of_study_options(parse_with_files(args, visible_options()), "a study of stability",
                                 "stability.h5");
}

}  // namespace pbmpi::app
