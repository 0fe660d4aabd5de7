// The registry with one more effect, which nothing calls for. It is linked instead of the library's own
// registry, which has another name in this program.
#include "effects/effects.h"

namespace pbmpi::effects {

const std::vector<Effect>& effects_of_the_library();

const std::vector<Effect>& effect_registry() {
  // At the end, since EffectId is the index of the others: a loop over the whole registry passes it.
  static const std::vector<Effect> effects = [] {
    const auto& others = effects_of_the_library();
    std::vector<Effect> all;
    all.reserve(others.size() + 1);  // no block is freed that others would then reuse
    all.insert(all.end(), others.begin(), others.end());
    const auto id = static_cast<EffectId>(others.size());
    all.push_back({id, "magnetism", "nothing is magnetic", core::Phase::rows,
                   [](const model::Model&) -> std::optional<Reason> { return std::nullopt; },
                   [](model::Model&) {}});
    return all;
  }();
  return effects;
}

}  // namespace pbmpi::effects
