#include "solver/layout/lane_places.h"

#include <algorithm>
#include <map>

#include "solver/layout/cells.h"

namespace pbmpi::solver {

LanePlaces::LanePlaces(std::span<const PackedWorld> worlds, int num_lanes, int most_bodies)
    : num_lanes_(num_lanes) {
  std::map<ArticulationShape, Copies> copies;
  for (std::size_t w = 0; w < worlds.size(); ++w) {
    const PackedWorld& world = worlds[w];
    worlds_.push_back({std::vector<LanePlace>(world.model->bodies.size()),
                       std::vector<JointPlace>(world.model->joints.size())});
    const std::vector<int> cells = find_cells(*world.model, world.articulations, most_bodies);
    for (std::size_t i = 0; i < cells.size(); ++i) {
      num_cells_ = std::max(num_cells_, cells[i] + 1);
      const Articulation& articulation = world.articulations[i];
      copies[articulation.shape].push_back({cells[i], static_cast<int>(w), &articulation});
    }
  }
  for (auto& [shape, members] : copies) {
    shapes_.push_back({shape, num_slots(), 0});
    place(members);
  }
}

/// Places the copies in the shape that was added last.
void LanePlaces::place(Copies& copies) {
  std::ranges::stable_sort(copies, {}, &Copy::cell);
  int lane = 0;
  for (std::size_t i = 0; i < copies.size(); ++i, ++lane) {
    if (i == 0 || lane == num_lanes_ || copies[i].cell != copies[i - 1].cell) {
      add_batch(copies[i].cell);
      lane = 0;
    }
    place(copies[i], shapes_.back().num_batches - 1, lane);
  }
}

/// To the shape that was added last.
void LanePlaces::add_batch(int cell) {
  ShapePlace& at = shapes_.back();
  ++at.num_batches;
  slots_.resize(slots_.size() + static_cast<std::size_t>(at.shape.num_bodies),
                {!at.shape.joints.empty(), 0, cell});
  world_at_.resize(slots_.size() * static_cast<std::size_t>(num_lanes_), -1);
}

void LanePlaces::place(const Copy& copy, int batch, int lane) {
  const ShapePlace& at = shapes_.back();
  const Articulation& articulation = *copy.articulation;
  World& world = worlds_[static_cast<std::size_t>(copy.world)];
  for (int i = 0; i < at.shape.num_bodies; ++i) {
    const int slot = at.first_slot + batch * at.shape.num_bodies + i;
    const int body = articulation.bodies[static_cast<std::size_t>(i)];
    world.bodies[static_cast<std::size_t>(body)] = {slot, lane};
    world_at_[static_cast<std::size_t>(slot * num_lanes_ + lane)] = copy.world;
    slots_[static_cast<std::size_t>(slot)].num_used = lane + 1;
  }
  const auto num_joints = static_cast<int>(at.shape.joints.size());
  for (int j = 0; j < num_joints; ++j) {
    world.joints[static_cast<std::size_t>(articulation.joints[static_cast<std::size_t>(j)])] = {
        static_cast<int>(shapes_.size()) - 1, batch * num_joints + j, lane};
  }
}

}  // namespace pbmpi::solver
