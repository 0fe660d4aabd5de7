#include "ode/collide/broad_phase.h"

#include <algorithm>
#include <array>

namespace pbmpi::ode {
namespace {

SpaceHandle make_space(SpaceKind kind) {
  return SpaceHandle(kind == SpaceKind::simple ? dSimpleSpaceCreate(nullptr)
                                               : dSweepAndPruneSpaceCreate(nullptr, dSAP_AXES_XYZ));
}

const GeomTag& tag_of(dGeomID geom) { return *static_cast<const GeomTag*>(dGeomGetData(geom)); }

bool boxes_overlap(dGeomID a, dGeomID b) {
  std::array<dReal, 6> box_a, box_b;
  dGeomGetAABB(a, box_a.data());
  dGeomGetAABB(b, box_b.data());
  for (int axis = 0; axis < 6; axis += 2) {
    if (box_a[axis] > box_b[axis + 1] || box_b[axis] > box_a[axis + 1]) return false;
  }
  return true;
}

}  // namespace

SpaceKind best_space(std::size_t num_geoms) {
  constexpr std::size_t crossover = 48;
  return num_geoms <= crossover ? SpaceKind::simple : SpaceKind::sweep_and_prune;
}

BroadPhase::BroadPhase(const model::Model& model, const std::vector<dBodyID>& bodies, SpaceKind kind)
    : space_(make_space(kind)), geoms_(model, bodies, space_.get()) {}

const std::vector<GeomPair>& BroadPhase::find_pairs() {
  pairs_.clear();
  dSpaceCollide(space_.get(), this, offer);
  std::sort(pairs_.begin(), pairs_.end());
  return pairs_;
}

void BroadPhase::offer(void* self, dGeomID a, dGeomID b) {
  auto& broad = *static_cast<BroadPhase*>(self);
  const GeomTag& tag_a = tag_of(a);
  const GeomTag& tag_b = tag_of(b);
  if (!broad.geoms_.may_touch(tag_a, tag_b)) return;
  // The sweep-and-prune space reports a plane with every geom, because its box is infinite along some axes.
  if ((tag_a.is_plane || tag_b.is_plane) && !boxes_overlap(a, b)) return;
  const auto [first, second] = std::minmax(tag_a.index, tag_b.index);
  broad.pairs_.push_back({first, second});
}

}  // namespace pbmpi::ode
