#include "app/pbreport/effects/effects.h"

#include "app/pbreport/effects/effects_markdown.h"
#include "app/pbreport/effects/effects_page.h"
#include "app/pbreport/effects/effects_text.h"
#include "app/pbreport/study/study_report.h"

namespace pbmpi::app {
namespace {

const StudyReport effects_report{
    "effects", "what each effect costs", "share of the step and error if left out, effect by scene",
    "print a table a stepper instead: share of the step [%] and defect without the effect, in "
    "brackets what demanding it costs"};

}  // namespace

core::ExitCode run_effects_report(const std::vector<std::string>& args, std::ostream& out) {
  return run_study_report(effects_report, args, out,
                          [](const io::TableFile& file, const ReportOfStudyOptions& options) {
                            const std::vector<EffectScene> scenes = effect_scenes(file, options.scenes);
                            return StudyViews{[scenes, options, &file](const std::string& path) {
                                                write_effects_page(path, file, scenes, options);
                                              },
                                              [scenes, &file] { return effects_to_json(file, scenes); },
                                              [scenes] { return effects_to_markdown(scenes); },
                                              [scenes, &file] { return effects_to_text(file, scenes); }};
                          });
}

}  // namespace pbmpi::app
