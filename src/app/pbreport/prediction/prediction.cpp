#include "app/pbreport/prediction/prediction.h"

#include "app/pbreport/prediction/prediction_page.h"
#include "app/pbreport/prediction/prediction_text.h"
#include "app/pbreport/study/study_report.h"

namespace pbmpi::app {
namespace {

const StudyReport prediction_report{
    "prediction",
    "what value prediction gains a frame and does to its result, and what of the "
    "paper's statements about it "
    "is confirmed",
    "the bars of Figure 8, hits, errors, and the verdicts",
    "print frame rates and verdicts as tables instead"};

}  // namespace

Manual prediction_report_manual() { return manual_of(prediction_report); }

core::ExitCode run_prediction_report(const std::vector<std::string>& args, std::ostream& out) {
  return run_study_report(prediction_report, args, out,
                          [](const io::TableFile& file, const ReportOfStudyOptions& options) {
                            const PredictionStudy study = prediction_study(file, options.scenes);
                            return StudyViews{[study, options, &file](const std::string& path) {
                                                write_prediction_page(path, file, study, options.file);
                                              },
                                              [study] { return prediction_to_json(study); },
                                              [study] { return prediction_to_markdown(study); },
                                              [study] { return prediction_to_text(study); }};
                          });
}

}  // namespace pbmpi::app
