#include "app/pbreport/effects/effects_options.h"

#include <sstream>

#include "app/common/options.h"
#include "core/error.h"

namespace pbmpi::app {
namespace {

namespace po = boost::program_options;
using core::require_input;

po::options_description visible_options() {
  po::options_description all("Options");
  add_scene_choice(all);
  add_output_options("share of the step and error if left out, effect by scene", all);
  all.add_options()                               //
      ("json", "print all as one JSON document")  //
      ("markdown",
       "print a table a stepper instead: share of the step [%] and defect without the effect, in "
       "brackets what demanding it costs");
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

EffectsReportOptions parse_effects_report_options(const std::vector<std::string>& args) {
  const po::variables_map values = parse_study_report(args, visible_options());
  EffectsReportOptions options;
  static_cast<ReportOfStudyOptions&>(options) =
      report_of_study_options(values, "a study of effects", "effects.h5");
  if (options.help) return options;
  options.markdown = values.count("markdown") != 0;
  require_input(!options.json || !options.markdown, "--json and --markdown: print one of the two");
  return options;
}

}  // namespace pbmpi::app
