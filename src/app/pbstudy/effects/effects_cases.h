/// The cases of "pbstudy effects": pure data, the same on every rank.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/manual/manual.h"
#include "app/pbstudy/study/setting_lists.h"
#include "app/pbstudy/study/study_options.h"
#include "effects/effects.h"

namespace pbmpi::app {

struct EffectsOptions : StudyOptions {
  std::vector<std::string> effects;   ///< names in the registry's order
  std::vector<SettingList> settings;  ///< of the steppers to measure
  std::optional<int> iterations;      ///< empty: the scene's
};

/// Throws core::InputError with one clear message.
EffectsOptions parse_effects_options(const std::vector<std::string>& args);

Manual effects_manual();
Study run_effects;

/// What a case changes in the scene.
enum class EffectCaseKind {
  left_out,  ///< takes away an effect that the scene has
  demanded,  ///< adds an effect that the scene does not have
  refused,   ///< an effect that cannot be changed; nothing is measured
  floor,     ///< changes the solver's seed only: the effect of noise alone, on errors and on times
};
inline constexpr std::array<std::string_view, 4> effect_case_kind_names = {"left_out", "demanded", "refused",
                                                                           "floor"};

struct EffectCase {
  int scene = 0;  ///< index into the study's scenes
  EffectCaseKind kind = EffectCaseKind::floor;
  stepping::StepperSettings stepper;  ///< the variant's; a floor's baseline has the study's seed
  std::string effect;                 ///< empty for a floor
  bool called_for = false;            ///< by something in the scene
  std::string reason;                 ///< what calls for it, or why it is refused
  int num_bodies = 0;                 ///< of its worlds, if all are like the first

  /// The choices that turn the scene into the variant.
  model::EffectChoices choices() const;
  double cost() const;  ///< expected, in any unit
};

/// All cases of all scenes, scene by scene and stepper by stepper. Throws core::InputError for a scene that
/// cannot be built.
std::vector<EffectCase> make_effect_cases(const std::vector<StudyScene>& scenes,
                                          const EffectsOptions& options);

}  // namespace pbmpi::app
