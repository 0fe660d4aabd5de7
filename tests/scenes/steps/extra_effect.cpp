// The registry with one more effect, which nothing calls for. It is linked instead of the library's own,
// which this program has under another name.
#include "effects/effects.h"

namespace pbmpi::effects {

const std::vector<Effect>& effects_of_the_library();

const std::vector<Effect>& effect_registry() {
  // In front, so that whoever looked through the registry in a step would pass it.
  static const std::vector<Effect> effects = [] {
    const auto& others = effects_of_the_library();
    std::vector<Effect> all;
    all.reserve(others.size() + 1);  // no block is freed, into which others would then be put
    all.push_back({"magnetism", "nothing is magnetic", core::Phase::rows,
                   [](const model::Model&) -> std::optional<Reason> { return std::nullopt; },
                   [](model::Model&) {}});
    all.insert(all.end(), others.begin(), others.end());
    return all;
  }();
  return effects;
}

}  // namespace pbmpi::effects
