#include "app/pbreport/engines/engines.h"

#include <ostream>

#include "app/common/text_output.h"
#include "app/pbreport/engines/engines_data.h"
#include "app/pbreport/engines/engines_page.h"
#include "app/pbreport/engines/engines_text.h"

namespace pbmpi::app {

core::ExitCode run_engines(const std::vector<std::string>& args, std::ostream& out) {
  const EnginesOptions options = parse_engines_options(args);
  if (options.help) {
    out << help_of(engines_manual());
    require_printed(out, "the help");
    return core::ExitCode::done;
  }
  const EnginesReport report = read_engines(options);
  if (options.html) write_engines_page(*options.html, report);
  if (options.form == PrintForm::json) {
    out << engines_to_json(report);
  } else if (options.form == PrintForm::markdown) {
    out << engines_to_markdown(report);
  } else if (!options.quiet) {
    out << engines_to_text(report);
  }
  require_printed(out, "the report");
  return core::ExitCode::done;
}

}  // namespace pbmpi::app
