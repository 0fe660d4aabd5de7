#include <algorithm>

#include "core/error.h"
#include "effects/effects.h"

namespace pbmpi::effects {

StepPlan::StepPlan(const model::Model& model) {
  for (const Effect& effect : effect_registry()) {
    const auto choice = model.effects.find(effect.name);
    if (choice != model.effects.end() && !choice->second) continue;
    if (auto reason = effect.reason(model)) {
      passes_.push_back({&effect, *reason, false});
    } else if (choice != model.effects.end()) {
      passes_.push_back({&effect, {0, "demanded; nothing calls for it"}, true});
    }
  }
}

const Pass* StepPlan::find(std::string_view effect) const {
  const auto& registry = effect_registry();
  core::require_invariant(
      std::any_of(registry.begin(), registry.end(), [&](const Effect& e) { return e.name == effect; }),
      "StepPlan was asked for a name that is not in the registry");
  const auto found =
      std::find_if(passes_.begin(), passes_.end(), [&](const Pass& p) { return p.effect->name == effect; });
  return found == passes_.end() ? nullptr : &*found;
}

bool StepPlan::is_idle(std::string_view effect) const {
  const Pass* pass = find(effect);
  return pass != nullptr && pass->idle;
}

}  // namespace pbmpi::effects
