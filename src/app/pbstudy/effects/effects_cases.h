/// The cases of "pbstudy effects": pure data, the same on every rank.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "app/pbstudy/effects/effects_options.h"
#include "effects/effects.h"

namespace pbmpi::app {

/// What a case does to the scene as it is.
enum class EffectCaseKind {
  left_out,  ///< takes an effect away that the scene has
  demanded,  ///< adds one that it does not have
  refused,   ///< an effect that cannot be changed; nothing is measured
  floor,     ///< changes the solver's seed only: what noise alone does, to errors and to times
};
inline constexpr std::array<std::string_view, 4> effect_case_kind_names = {"left_out", "demanded", "refused",
                                                                           "floor"};

struct EffectCase {
  int scene = 0;  ///< index into the study's scenes
  EffectCaseKind kind = EffectCaseKind::floor;
  stepping::StepperSettings stepper;  ///< of a floor's variant; its baseline has the study's seed
  std::string effect;                 ///< empty: floor
  bool called_for = false;            ///< by something in the scene
  std::string reason;                 ///< what calls for it, or why it is refused

  /// What makes the variant out of the scene.
  model::EffectChoices choices() const;
};

/// All cases of all scenes, scene by scene and stepper by stepper. Throws core::InputError for a scene that
/// cannot be built.
std::vector<EffectCase> make_effect_cases(const std::vector<StudyScene>& scenes,
                                          const EffectsOptions& options);

/// Which rank works on which case [num_cases]: by expected cost, the dearest first.
std::vector<int> deal_out(const std::vector<EffectCase>& cases, const std::vector<StudyScene>& scenes,
                          int num_ranks);

}  // namespace pbmpi::app
