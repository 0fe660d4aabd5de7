#include "app/pbreport/scaling/scaling.h"

#include <ostream>

#include "app/common/text_output.h"
#include "app/pbreport/scaling/scaling_options.h"
#include "app/pbreport/scaling/scaling_page.h"
#include "app/pbreport/scaling/scaling_tables.h"
#include "app/pbreport/scaling/scaling_text.h"
#include "app/pbreport/tables/table_json.h"
#include "io/file/write_file.h"
#include "io/table/csv_text.h"

namespace pbmpi::app {

core::ExitCode run_scaling(const std::vector<std::string>& args, std::ostream& out) {
  const ScalingOptions options = parse_scaling_options(args);
  if (options.help) {
    out << help_of(scaling_manual());
    require_printed(out, "the help");
    return core::ExitCode::done;
  }
  std::vector<ScalingRun> runs;
  for (const std::string& file : options.files) runs.push_back(read_scaling_run(file));
  const std::vector<ScalingCurve> curves = curves_of(runs, options.rules);
  core::require_input(!curves.empty(),
                      "scaling: no two of the " + std::to_string(runs.size()) +
                          " runs do the same work on different numbers of ranks; give runs that differ in "
                          "ranks alone, or in ranks and worlds");
  if (options.html) write_scaling_page(*options.html, runs, curves);
  const io::TableFile tables = scaling_tables(curves);
  if (options.csv) io::write_file(*options.csv, io::csv_table(tables.tables.at(options.table), true));
  if (options.form == PrintForm::json) {
    out << to_json(tables);
  } else if (options.form == PrintForm::markdown) {
    out << scaling_markdown(curves);
  } else if (!options.quiet) {
    out << scaling_text(curves, files_without_curve(runs, curves));
  }
  require_printed(out, "the report");
  return core::ExitCode::done;
}

}  // namespace pbmpi::app
