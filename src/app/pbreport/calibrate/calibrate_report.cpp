#include "app/pbreport/calibrate/calibrate_report.h"

#include "app/common/text_output.h"
#include "app/pbreport/calibrate/calibrate_report_options.h"
#include "app/pbreport/calibrate/forecast_text.h"
#include "app/pbreport/study/study_file.h"
#include "app/pbreport/tables/table_json.h"
#include "io/file/write_file.h"
#include "io/table/csv_text.h"

namespace pbmpi::app {

core::ExitCode run_calibrate_report(const std::vector<std::string>& args, std::ostream& out) {
  const CalibrateReportOptions options = parse_calibrate_report_options(args);
  if (options.help) {
    out << help_of(calibrate_report_manual());
    require_printed(out, "the help");
    return core::ExitCode::done;
  }
  const Calibration calibration = calibration_of(read_study(options.file, "calibrate"));
  const io::TableFile tables = forecast_tables(calibration, options.question);
  if (options.csv) io::write_file(*options.csv, io::csv_table(tables.tables.at(options.table), true));
  const bool markdown = options.form == PrintForm::markdown;
  if (options.form == PrintForm::json) {
    out << to_json(tables);
  } else if (markdown || !options.quiet) {
    out << forecast_text(calibration, options.question, markdown);
  }
  require_printed(out, "the report");
  return core::ExitCode::done;
}

}  // namespace pbmpi::app
