#include "app/pbreport/ensemble/ensemble.h"

#include <ostream>

#include "app/common/text_output.h"
#include "app/pbreport/ensemble/ensemble_text.h"
#include "app/pbreport/tables/table_json.h"
#include "io/file/write_file.h"
#include "io/table/csv_text.h"

namespace pbmpi::app {
namespace {

std::string printed(const EnsembleRuns& runs, const Ensemble& found, const EnsembleOptions& options,
                    const io::TableFile& file) {
  switch (options.form) {
    case PrintForm::json:
      return to_json(file);
    case PrintForm::markdown:
      return ensemble_markdown(runs, found, options);
    case PrintForm::text:
      return options.quiet ? "" : ensemble_text(runs, found, options);
  }
  return "";
}

}  // namespace

core::ExitCode run_ensemble(const std::vector<std::string>& args, std::ostream& out) {
  const EnsembleOptions options = parse_ensemble_options(args);
  if (options.help) {
    out << help_of(ensemble_manual());
    require_printed(out, "the help");
    return core::ExitCode::done;
  }
  std::optional<io::OutputLock> output;  // an unwritable path is reported before the work
  if (options.output)
    output = io::output_target(*options.output, ensemble_filetype, io::table_bytes).take_lock();
  const EnsembleRuns runs(options);
  Ensemble found;
  found.quantities = spread_by_frame(runs, options.quantiles);
  found.positions = spread_of_positions(runs, options.quantiles, options.by_body);
  found.worlds = facts_of_worlds(runs);
  const io::TableFile file = ensemble_tables(runs, found, options);
  if (output) io::replace_file(*output, io::table_image(ensemble_filetype, io::study_version, file));
  if (options.csv) io::write_file(*options.csv, io::csv_table(file.tables.at(options.table), true));
  out << printed(runs, found, options, file);
  require_printed(out, "the ensemble");
  return core::ExitCode::done;
}

}  // namespace pbmpi::app
