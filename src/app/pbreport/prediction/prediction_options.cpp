#include "app/pbreport/prediction/prediction_options.h"

#include <sstream>

#include "app/common/options.h"

namespace pbmpi::app {
namespace {

namespace po = boost::program_options;

po::options_description visible_options() {
  po::options_description all("Options");
  add_scene_choice(all);
  add_output_options("the bars of Figure 8, hits, errors, and the verdicts", all);
  add_print_options("print frame rates and verdicts as tables instead", all);
  add_general_options("--json or --markdown", all);
  return all;
}

}  // namespace

std::string prediction_report_help_text() {
  std::ostringstream text;
  text << "pbreport prediction shows what value prediction gains a frame and does to its result, and what of "
          "the "
          "paper's statements about it is confirmed: the file of pbstudy prediction. The word prediction may "
          "be "
          "left out.\n\n"
       << "Usage: pbreport [prediction] prediction.h5 [options]\n\n"
       << visible_options();
  return text.str();
}

ReportOfStudyOptions parse_prediction_report_options(const std::vector<std::string>& args) {
  return report_of_study_options(parse_with_files(args, visible_options()), "a study of prediction",
                                 "prediction.h5");
}

}  // namespace pbmpi::app
