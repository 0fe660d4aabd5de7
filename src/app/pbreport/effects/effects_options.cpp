#include "app/pbreport/effects/effects_options.h"

#include <sstream>

#include "app/common/options.h"

namespace pbmpi::app {
namespace {

namespace po = boost::program_options;

po::options_description visible_options() {
  po::options_description all("Options");
  add_scene_choice(all);
  add_output_options("share of the step and error if left out, effect by scene", all);
  add_print_options(
      "print a table a stepper instead: share of the step [%] and defect without the effect, in "
      "brackets what demanding it costs",
      all);
  add_general_options("--json or --markdown", all);
  return all;
}

}  // namespace

std::string effects_report_help_text() {
  std::ostringstream text;
  text << "pbreport effects shows what each effect costs: the file of pbstudy effects. The word effects may "
          "be left out.\n\n"
       << "Usage: pbreport [effects] effects.h5 [options]\n\n"
       << visible_options();
  return text.str();
}

ReportOfStudyOptions parse_effects_report_options(const std::vector<std::string>& args) {
  return report_of_study_options(parse_with_files(args, visible_options()), "a study of effects",
                                 "effects.h5");
}

}  // namespace pbmpi::app
