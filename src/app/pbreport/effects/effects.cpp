#include "app/pbreport/effects/effects.h"

#include <ostream>

#include "app/common/text_output.h"
#include "app/pbreport/effects/effects_markdown.h"
#include "app/pbreport/effects/effects_page.h"
#include "app/pbreport/effects/effects_text.h"
#include "app/pbreport/study/study_file.h"
#include "io/file/write_file.h"

namespace pbmpi::app {

core::ExitCode run_effects_report(const std::vector<std::string>& args, std::ostream& out) {
  const ReportOfStudyOptions options = parse_effects_report_options(args);
  if (options.help) {
    out << effects_report_help_text();
    return core::ExitCode::done;
  }
  const io::TableFile file = read_study(options.file, "effects");
  const std::vector<EffectScene> scenes = effect_scenes(file, options.scenes);
  if (options.csv) io::write_file(*options.csv, study_to_csv(file));
  if (options.html) write_effects_page(*options.html, file, scenes, options);
  if (options.json) {
    out << effects_to_json(file, scenes);
  } else if (options.markdown) {
    out << effects_to_markdown(scenes);
  } else if (!options.quiet) {
    out << effects_to_text(file, scenes);
  }
  require_printed(out, "the report");
  return core::ExitCode::done;
}

}  // namespace pbmpi::app
