#include "solver/layout/lane_places.h"

#include <map>

namespace pbmpi::solver {

LanePlaces::LanePlaces(std::span<const PackedWorld> worlds, int num_lanes) : num_lanes_(num_lanes) {
  std::map<ArticulationShape, Copies> copies;
  for (std::size_t w = 0; w < worlds.size(); ++w) {
    worlds_.push_back({std::vector<LanePlace>(worlds[w].model->bodies.size()),
                       std::vector<JointPlace>(worlds[w].model->joints.size())});
    for (const Articulation& articulation : worlds[w].articulations)
      copies[articulation.shape].emplace_back(static_cast<int>(w), &articulation);
  }
  for (const auto& [shape, members] : copies) {
    const int num_batches = (static_cast<int>(members.size()) + num_lanes - 1) / num_lanes;
    shapes_.push_back({shape, num_slots(), num_batches});
    slots_.resize(slots_.size() + static_cast<std::size_t>(num_batches * shape.num_bodies),
                  {!shape.joints.empty(), 0});
    world_at_.resize(slots_.size() * static_cast<std::size_t>(num_lanes), -1);
    place(members);
  }
}

/// Places the copies in the shape that was added last.
void LanePlaces::place(const Copies& copies) {
  const auto& [shape, first_slot, num_batches] = shapes_.back();
  for (std::size_t m = 0; m < copies.size(); ++m) {
    const auto& [w, articulation] = copies[m];
    World& world = worlds_[static_cast<std::size_t>(w)];
    const int batch = static_cast<int>(m) / num_lanes_, lane = static_cast<int>(m) % num_lanes_;
    for (int i = 0; i < shape.num_bodies; ++i) {
      const int slot = first_slot + batch * shape.num_bodies + i;
      const int body = articulation->bodies[static_cast<std::size_t>(i)];
      world.bodies[static_cast<std::size_t>(body)] = {slot, lane};
      world_at_[static_cast<std::size_t>(slot * num_lanes_ + lane)] = w;
      slots_[static_cast<std::size_t>(slot)].num_used = lane + 1;
    }
    for (std::size_t j = 0; j < shape.joints.size(); ++j) {
      const int joint = batch * static_cast<int>(shape.joints.size()) + static_cast<int>(j);
      world.joints[static_cast<std::size_t>(articulation->joints[j])] = {
          static_cast<int>(&shapes_.back() - shapes_.data()), joint, lane};
    }
  }
}

}  // namespace pbmpi::solver
