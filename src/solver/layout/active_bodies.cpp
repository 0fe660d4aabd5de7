#include "solver/layout/active_bodies.h"

#include <numeric>

namespace pbmpi::solver {

void ActiveBodies::add_world(int num_bodies) {
  World& world = worlds_.emplace_back();
  world.bodies.resize(static_cast<std::size_t>(num_bodies));
  std::iota(world.bodies.begin(), world.bodies.end(), 0);
  world.is_active.assign(world.bodies.size(), 1);
}

void ActiveBodies::set(int world, std::span<const int> bodies) {
  World& changed = worlds_[static_cast<std::size_t>(world)];
  changed.bodies.assign(bodies.begin(), bodies.end());
  changed.is_active.assign(changed.is_active.size(), 0);
  for (const int body : bodies) changed.is_active[static_cast<std::size_t>(body)] = 1;
  ++revision_;
}

}  // namespace pbmpi::solver
