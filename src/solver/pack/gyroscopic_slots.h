/// Which bodies of a pack have gyroscopic torque.
#pragma once

#include <span>
#include <vector>

#include "effects/effects.h"
#include "geometry/principal_axes.h"
#include "solver/layout/free_turning.h"
#include "solver/layout/lane_places.h"

namespace pbmpi::solver {

/// A slot of bodies with gyroscopic torque, and 1 in the lanes that have it, else 0.
template <class V>
struct alignas(sizeof(V)) GyroscopicSlot {
  V has_torque;
  PrincipalInertia<V> inertia;
  int slot = 0;
};

template <class T>
void set_inertia(const geometry::PrincipalAxes& from, int lane, PrincipalInertia<typename T::V>& to) {
  using Scalar = typename T::Scalar;
  T::set(to.w, lane, static_cast<Scalar>(from.to_body.w));
  T::set(to.x, lane, static_cast<Scalar>(from.to_body.x));
  T::set(to.y, lane, static_cast<Scalar>(from.to_body.y));
  T::set(to.z, lane, static_cast<Scalar>(from.to_body.z));
  T::set(to.per_moment.x, lane, static_cast<Scalar>(1 / from.moments.x()));
  T::set(to.per_moment.y, lane, static_cast<Scalar>(1 / from.moments.y()));
  T::set(to.per_moment.z, lane, static_cast<Scalar>(1 / from.moments.z()));
}

/// The slots with gyroscopic torque, in order. `all_slots`: also those in which no body has it.
template <class T>
std::vector<GyroscopicSlot<typename T::V>> find_gyroscopic_slots(const LanePlaces& places,
                                                                 std::span<const model::Model* const> models,
                                                                 bool all_slots) {
  using Slot = GyroscopicSlot<typename T::V>;
  const typename T::V zero = T::broadcast(0), one = T::broadcast(1);
  const Slot idle{zero, {one, zero, zero, zero, {one, one, one}}, 0};
  std::vector<Slot> slots(static_cast<std::size_t>(places.num_slots()), idle);
  std::vector<bool> used(slots.size(), all_slots);
  for (int world = 0; world < static_cast<int>(models.size()); ++world) {
    const model::Model& model = *models[static_cast<std::size_t>(world)];
    for (int body = 0; body < model.num_bodies(); ++body) {
      if (!effects::has_gyroscopic_torque(model.bodies[body])) continue;
      const LanePlace at = places.body(world, body);
      Slot& slot = slots[static_cast<std::size_t>(at.slot)];
      T::set(slot.has_torque, at.lane, 1);
      set_inertia<T>(geometry::principal_axes(model.bodies[body].inertia), at.lane, slot.inertia);
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
