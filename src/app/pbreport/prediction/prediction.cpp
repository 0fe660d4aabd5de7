#include "app/pbreport/prediction/prediction.h"

#include <ostream>

#include "app/common/text_output.h"
#include "app/pbreport/prediction/prediction_options.h"
#include "app/pbreport/prediction/prediction_page.h"
#include "app/pbreport/prediction/prediction_text.h"
#include "app/pbreport/study/study_file.h"
#include "io/file/write_file.h"

namespace pbmpi::app {

core::ExitCode run_prediction_report(const std::vector<std::string>& args, std::ostream& out) {
  const ReportOfStudyOptions options = parse_prediction_report_options(args);
  if (options.help) {
    out << prediction_report_help_text();
    return core::ExitCode::done;
  }
  const io::TableFile file = read_study(options.file, "prediction");
  const PredictionStudy study = prediction_study(file, options.scenes);
  if (options.csv) io::write_file(*options.csv, study_to_csv(file));
  if (options.html) write_prediction_page(*options.html, file, study);
  if (options.json) {
    out << prediction_to_json(study);
  } else if (options.markdown) {
    out << prediction_to_markdown(study);
  } else if (!options.quiet) {
    out << prediction_to_text(study);
  }
  require_printed(out, "the report");
  return core::ExitCode::done;
}

}  // namespace pbmpi::app
