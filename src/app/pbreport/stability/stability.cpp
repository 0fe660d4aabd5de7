#include "app/pbreport/stability/stability.h"

#include <ostream>

#include "app/common/text_output.h"
#include "app/pbreport/stability/stability_options.h"
#include "app/pbreport/stability/stability_page.h"
#include "app/pbreport/stability/stability_text.h"
#include "app/pbreport/study/study_file.h"
#include "io/file/write_file.h"

namespace pbmpi::app {

core::ExitCode run_stability_report(const std::vector<std::string>& args, std::ostream& out) {
  const ReportOfStudyOptions options = parse_stability_report_options(args);
  if (options.help) {
    out << stability_report_help_text();
    return core::ExitCode::done;
  }
  const io::TableFile file = read_study(options.file, "stability");
  const StabilityMap map = stability_map(file, options.scenes);
  if (options.csv) io::write_file(*options.csv, study_to_csv(file));
  if (options.html) write_stability_page(*options.html, file, map);
  if (options.json) {
    out << stability_to_json(map);
  } else if (options.markdown) {
    out << stability_to_markdown(map);
  } else if (!options.quiet) {
    out << stability_to_text(map);
  }
  require_printed(out, "the report");
  return core::ExitCode::done;
}

}  // namespace pbmpi::app
