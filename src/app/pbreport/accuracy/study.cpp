#include "app/pbreport/accuracy/study.h"

#include <ostream>

#include "app/common/text_output.h"
#include "app/pbreport/accuracy/study_page.h"
#include "app/pbreport/accuracy/study_text.h"
#include "app/pbreport/study/study_file.h"
#include "io/file/write_file.h"

namespace pbmpi::app {
namespace {

void write_config(const std::vector<SceneCases>& scenes, const AccuracyReportOptions& options) {
  core::require_input(scenes.size() == 1, "--write-config holds one scene, the study has " +
                                              std::to_string(scenes.size()) + "; name one with --scene");
  const auto chosen = chosen_setting(scenes.front(), options);
  core::require_input(chosen.has_value(), "no setting of the study keeps what is asked for in " +
                                              scenes.front().name + "; ask for less or study more settings");
  io::write_file(*options.config, config_text(scenes.front().settings[*chosen]));
}

}  // namespace

core::ExitCode run_study(const std::vector<std::string>& args, std::ostream& out) {
  const AccuracyReportOptions options = parse_study_options(args);
  if (options.help) {
    out << help_of(study_manual());
    return core::ExitCode::done;
  }
  const io::TableFile file = read_study(options.file, "accuracy");
  const std::vector<SceneCases> scenes = study_scenes(file, options.scenes);
  if (options.config) write_config(scenes, options);
  if (options.csv) io::write_file(*options.csv, study_to_csv(file));
  if (options.html) write_study_page(*options.html, file, scenes, options);
  if (options.form == PrintForm::json) {
    out << study_to_json(scenes, options);
  } else if (!options.quiet) {
    out << study_to_text(file, scenes, options);
  }
  require_printed(out, "the report");
  return core::ExitCode::done;
}

}  // namespace pbmpi::app
