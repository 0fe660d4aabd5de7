/// Bodies that a step does not move but that share a batch with bodies that it moves: their lanes move along,
/// and are put back after the step.
#pragma once

#include <vector>

#include "solver/layout/body_lanes.h"
#include "solver/layout/lane_place.h"

namespace pbmpi::solver {

template <class T>
class HeldLanes {
 public:
  using V = typename T::V;

  /// Holds the bodies at these places from now on; `num_slots`: the pack's.
  template <class Places>
  void hold(int num_slots, const Places& places);

  /// 1 in the held lanes of a slot, else 0; null if none is held.
  const V* lanes(int slot) const {
    const int index = index_.empty() ? -1 : index_[static_cast<std::size_t>(slot)];
    return index < 0 ? nullptr : &slots_[static_cast<std::size_t>(index)].held;
  }

  void save(const BodyLanes<T>& bodies) {
    for (Slot& held : slots_) {
      held.body = bodies.bodies[held.slot];
      held.twist = bodies.twists[held.slot];
    }
  }
  void restore(BodyLanes<T>& bodies) const {
    for (const Slot& held : slots_) {
      BodyLane<V>& body = bodies.bodies[held.slot];
      put_back(held, held.body.position, body.position);
      put_back(held, held.body.position_low, body.position_low);
      for (V BodyLane<V>::*q : {&BodyLane<V>::qw, &BodyLane<V>::qx, &BodyLane<V>::qy, &BodyLane<V>::qz})
        body.*q = is_held(held) ? held.body.*q : body.*q;
      refresh(body);
      Twist<V>& twist = bodies.twists[held.slot];
      put_back(held, held.twist.linear, twist.linear);
      put_back(held, held.twist.angular, twist.angular);
    }
  }

 private:
  struct alignas(sizeof(V)) Slot {
    BodyLane<V> body;
    Twist<V> twist;
    V held;  ///< 1 in the lanes to be put back, else 0
    int slot = 0;
  };
  PBMPI_LANES static auto is_held(const Slot& held) { return held.held > T::broadcast(0); }
  PBMPI_LANES static void put_back(const Slot& held, const Vec3L<V>& before, Vec3L<V>& after) {
    after.x = is_held(held) ? before.x : after.x;
    after.y = is_held(held) ? before.y : after.y;
    after.z = is_held(held) ? before.z : after.z;
  }

  std::vector<Slot> slots_;
  std::vector<int> index_;  ///< [num_slots] index into slots_, or -1
};

template <class T>
template <class Places>
void HeldLanes<T>::hold(int num_slots, const Places& places) {
  slots_.clear();
  index_.assign(static_cast<std::size_t>(num_slots), -1);
  for (const LanePlace& at : places) {
    int& found = index_[static_cast<std::size_t>(at.slot)];
    if (found < 0) {
      found = static_cast<int>(slots_.size());
      Slot& held = slots_.emplace_back();
      held.held = T::broadcast(0);
      held.slot = at.slot;
    }
    T::set(slots_[static_cast<std::size_t>(found)].held, at.lane, 1);
  }
}

}  // namespace pbmpi::solver
