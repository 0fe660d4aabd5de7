#include "scenes/format/pair_reader.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace pbmpi::scenes {
PairPlan::PairPlan(TableReader& table) : where_(table.where("actors") + ": pair") {
  const std::vector<std::string> actors = table.texts("actors");
  if (actors.size() != 2) table.fail("actors", "'actors' must name two actors");
  actors_ = {actors[0], actors[1]};
  material_.mu = table.number("mu", Sign::non_negative);
  material_.restitution = table.number("restitution", Sign::non_negative, 0.0);
  if (material_.restitution > 1)
    table.fail("restitution", "'restitution' must lie in [0, 1] (above 1, each bounce gains energy)");
  table.finish();
}

void PairPlan::put_into(GrowingModel& model) const {
  const auto actors_of = [](const model::PairMaterial& one) { return std::pair(one.actor_a, one.actor_b); };
  for (const int a : model.named_actors(actors_[0], where_)) {
    for (const int b : model.named_actors(actors_[1], where_)) {
      const model::PairMaterial pair = {std::min(a, b), std::max(a, b), material_};
      std::vector<model::PairMaterial>& all = model.pair_materials;
      const auto at = std::ranges::lower_bound(all, actors_of(pair), {}, actors_of);
      if (at != all.end() && actors_of(*at) == actors_of(pair)) {
        *at = pair;
      } else {
        all.insert(at, pair);
      }
    }
  }
}

}  // namespace pbmpi::scenes
