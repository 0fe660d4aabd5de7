/// Where each body and joint of a pack's worlds lies: copies of one articulation shape are side by side in
/// lanes.
#pragma once

#include <span>
#include <vector>

#include "solver/layout/articulation.h"
#include "solver/layout/lane_place.h"
#include "solver/layout/packed_world.h"

namespace pbmpi::solver {

/// Where a joint lies; `joint` is its index into a shape's joints, [num_batches][shape.joints].
struct JointPlace {
  int shape = 0, joint = 0, lane = 0;
};

class LanePlaces {
 public:
  /// The slots of all articulations of one shape: body i of batch k is slot first_slot + k num_bodies + i.
  struct ShapePlace {
    ArticulationShape shape;
    int first_slot = 0, num_batches = 0;
  };

  /// Places bodies shape by shape, within a shape cell by cell, and within a cell world by world. Worlds are
  /// cut into cells of at most `most_bodies`; each cell begins a batch.
  LanePlaces(std::span<const PackedWorld> worlds, int num_lanes, int most_bodies);

  const std::vector<ShapePlace>& shapes() const { return shapes_; }
  /// The number of slots without the environment's static slot, which comes after them.
  int num_slots() const { return static_cast<int>(slots_.size()); }
  /// Where a body lies; the environment (no_body) lies in lane 0 of the static slot.
  LanePlace body(int world, int body) const {
    return body == model::no_body ? LanePlace{num_slots(), 0} : bodies(world).data()[body];
  }
  const std::vector<LanePlace>& bodies(int world) const {
    return worlds_[static_cast<std::size_t>(world)].bodies;
  }
  const JointPlace& joint(int world, int joint) const {
    return worlds_[static_cast<std::size_t>(world)].joints[static_cast<std::size_t>(joint)];
  }
  /// The world whose body lies there; -1 for the static slot and idle lanes.
  int world_at(LanePlace place) const {
    return place.slot == num_slots()
               ? -1
               : world_at_[static_cast<std::size_t>(place.slot * num_lanes_ + place.lane)];
  }
  /// Does the articulation that a slot belongs to have joints?
  bool has_joints(int slot) const { return slots_[static_cast<std::size_t>(slot)].has_joints; }
  int num_cells() const { return num_cells_; }
  /// The cell of all bodies of a slot, whichever world they belong to.
  int cell(int slot) const { return slots_[static_cast<std::size_t>(slot)].cell; }
  /// How many lanes of a slot, from the first on, have a body.
  int num_used(int slot) const { return slots_[static_cast<std::size_t>(slot)].num_used; }

 private:
  struct World {
    std::vector<LanePlace> bodies;
    std::vector<JointPlace> joints;
  };
  struct Slot {
    bool has_joints = false;
    int num_used = 0, cell = 0;
  };
  struct Copy {
    int cell = 0, world = 0;
    const Articulation* articulation = nullptr;
  };
  /// Articulations of one shape.
  using Copies = std::vector<Copy>;

  void place(Copies& copies);
  void add_batch(int cell);
  void place(const Copy& copy, int batch, int lane);

  int num_lanes_, num_cells_ = 0;
  std::vector<World> worlds_;
  std::vector<ShapePlace> shapes_;
  std::vector<Slot> slots_;    ///< without the static one
  std::vector<int> world_at_;  ///< [slots x num_lanes]
};

}  // namespace pbmpi::solver
