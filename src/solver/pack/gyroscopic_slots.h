/// Which bodies of a pack have gyroscopic torque.
#pragma once

#include <span>
#include <vector>

#include "effects/effects.h"
#include "solver/lanes/lanes.h"
#include "solver/layout/lane_places.h"

namespace pbmpi::solver {

/// A slot of bodies with gyroscopic torque, and 1 in the lanes that have it, else 0.
template <class V>
struct alignas(sizeof(V)) GyroscopicSlot {
  V has_torque;
  int slot = 0;
};

/// The slots with gyroscopic torque, in order. `all_slots`: also those in which no body has it.
template <class T>
std::vector<GyroscopicSlot<typename T::V>> find_gyroscopic_slots(const LanePlaces& places,
                                                                 std::span<const model::Model* const> models,
                                                                 bool all_slots) {
  using Slot = GyroscopicSlot<typename T::V>;
  std::vector<Slot> slots(static_cast<std::size_t>(places.num_slots()), Slot{T::broadcast(0), 0});
  std::vector<bool> used(slots.size(), all_slots);
  for (int world = 0; world < static_cast<int>(models.size()); ++world) {
    const model::Model& model = *models[static_cast<std::size_t>(world)];
    for (int body = 0; body < model.num_bodies(); ++body) {
      if (!effects::has_gyroscopic_torque(model.bodies[body])) continue;
      const LanePlace at = places.body(world, body);
      T::set(slots[static_cast<std::size_t>(at.slot)].has_torque, at.lane, 1);
      used[static_cast<std::size_t>(at.slot)] = true;
    }
  }
  std::vector<Slot> found;
  for (std::size_t slot = 0; slot < used.size(); ++slot) {
    slots[slot].slot = static_cast<int>(slot);
    if (used[slot]) found.push_back(slots[slot]);
  }
  return found;
}

}  // namespace pbmpi::solver
