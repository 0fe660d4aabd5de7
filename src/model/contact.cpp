#include "model/contact.h"

#include <algorithm>
#include <utility>

namespace pbmpi::model {

const Material* find_pair_material(const Model& model, const GeomPair& pair) {
  const std::pair<int, int> actors =
      std::minmax({model.geoms[pair.first].actor, model.geoms[pair.second].actor});
  const auto actors_of = [](const PairMaterial& one) { return std::pair(one.actor_a, one.actor_b); };
  const auto found = std::ranges::lower_bound(model.pair_materials, actors, {}, actors_of);
  return found != model.pair_materials.end() && actors_of(*found) == actors ? &found->material : nullptr;
}

}  // namespace pbmpi::model
