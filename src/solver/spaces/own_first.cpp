#include "solver/spaces/own_first.h"

#include <algorithm>
#include <utility>

namespace pbmpi::solver {
namespace {

std::vector<int> own_and_static_geoms(const model::Model& model, const model::SpaceMap& map,
                                      std::span<const char> is_own) {
  std::vector<int> geoms;
  for (std::size_t i = 0; i < model.geoms.size(); ++i) {
    const int body = model.geoms[i].body;
    if (body == model::no_body || is_own[map.space_of_body(body)] != 0) geoms.push_back(static_cast<int>(i));
  }
  return geoms;
}

}  // namespace

PackedWorld pack_own_first(const model::Model& model, const model::SpaceMap& map,
                           std::span<const Articulation> articulations, std::span<const char> is_own) {
  std::vector<const Articulation*> order;
  for (const Articulation& articulation : articulations) order.push_back(&articulation);
  const auto key = [&](const Articulation* articulation) {
    const int space = map.space_of_body(articulation->bodies.front());
    return std::pair(is_own[space] == 0, space);
  };
  std::stable_sort(order.begin(), order.end(), [&](const auto* a, const auto* b) { return key(a) < key(b); });
  PackedWorld packed;
  packed.model = &model;
  packed.swept_geoms = own_and_static_geoms(model, map, is_own);
  for (const Articulation* articulation : order) packed.articulations.push_back(*articulation);
  return packed;
}

}  // namespace pbmpi::solver
