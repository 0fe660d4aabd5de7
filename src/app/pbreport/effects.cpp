#include "app/pbreport/effects.h"

#include <algorithm>
#include <ostream>

#include "app/pbreport/effects_markdown.h"
#include "app/pbreport/effects_page.h"
#include "app/pbreport/effects_text.h"
#include "app/pbreport/study.h"
#include "app/pbreport/study_text.h"

namespace pbmpi::app {

bool names_an_effect_study(const std::vector<std::string>& args) {
  return std::any_of(args.begin(), args.end(), [](const std::string& arg) {
    return !arg.empty() && arg.front() != '-' && is_effect_study(arg);
  });
}

core::ExitCode run_effects_report(const std::vector<std::string>& args, std::ostream& out) {
  const EffectsReportOptions options = parse_effects_report_options(args);
  if (options.help) {
    out << effects_report_help_text();
    return core::ExitCode::done;
  }
  const io::TableFile file = io::read_table_file(options.file, study_filetype);
  core::require_input(is_effect_study(options.file),
                      options.file + ": a study, but not one of effects; try pbreport study");
  const std::vector<EffectScene> scenes = effect_scenes(file, options.scenes);
  if (options.csv) write_text(*options.csv, study_to_csv(file));
  if (options.html) write_effects_page(*options.html, file, scenes, options);
  if (options.json) {
    out << effects_to_json(file, scenes);
  } else if (options.markdown) {
    out << effects_to_markdown(scenes);
  } else if (!options.quiet) {
    out << effects_to_text(file, scenes);
  }
  out.flush();
  if (!out) throw core::RunError("the report cannot be written to standard output; is the disk full?");
  return core::ExitCode::done;
}

}  // namespace pbmpi::app
