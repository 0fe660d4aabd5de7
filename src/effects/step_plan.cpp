#include <algorithm>

#include "effects/effects.h"

namespace pbmpi::effects {

std::optional<bool> choice_of(const model::Model& model, EffectId effect) {
  const auto choice = model.effects.find(effect_registry()[static_cast<std::size_t>(effect)].name);
  return choice == model.effects.end() ? std::nullopt : std::optional(choice->second);
}

StepPlan::StepPlan(const model::Model& model) {
  for (const Effect& effect : effect_registry()) {
    const std::optional<bool> choice = choice_of(model, effect.id);
    if (choice == std::optional<bool>(false)) continue;
    if (auto reason = effect.reason(model)) {
      passes_.push_back({&effect, *reason, false});
    } else if (choice) {
      passes_.push_back({&effect, {0, "demanded; nothing calls for it"}, true});
    }
  }
}

const Pass* StepPlan::find(EffectId effect) const {
  const auto found = std::find_if(passes_.begin(), passes_.end(),
                                  [&](const Pass& pass) { return pass.effect->id == effect; });
  return found == passes_.end() ? nullptr : &*found;
}

bool StepPlan::is_idle(EffectId effect) const {
  const Pass* pass = find(effect);
  return pass != nullptr && pass->idle;
}

}  // namespace pbmpi::effects
