/// Which worlds of a pack have a body that may be fast or approach others (effects/fast_bodies.h) in a step,
/// or slow.
#pragma once

#include <bit>
#include <cstddef>
#include <span>
#include <vector>

#include "effects/fast_bodies.h"
#include "solver/pack/world_lanes.h"

namespace pbmpi::solver {

/// Sets marks[num_worlds] of the worlds that have a flag other than 0 in their lanes of a slot.
template <class T>
void mark_worlds(const LanePlaces& places, int slot, const typename T::V& flags, std::vector<char>& marks) {
  for (unsigned lanes = T::bits(flags); lanes != 0; lanes &= lanes - 1) {
    const int world = places.world_at({slot, std::countr_zero(lanes)});
    if (world >= 0) marks[static_cast<std::size_t>(world)] = 1;
  }
}

template <class T>
class SpeedBounds {
 public:
  using V = typename T::V;
  using Scalar = typename T::Scalar;

  SpeedBounds(const WorldLanes<T>& worlds, std::span<const PackedWorld> packed);

  /// Sets may_be_fast[num_worlds], initially 0, where a body exceeds its effects::SlowBound in a step of
  /// `dt_s`.
  void find_fast(const WorldLanes<T>& worlds, double dt_s, std::vector<char>& may_be_fast) const;

 private:
  struct alignas(sizeof(V)) Slot {
    V way2, turn2;  ///< squares of a body's SlowBound; infinite in idle lanes
    /// Above 0 in the lanes of bodies that exceed their bound. NaN counts as slow.
    V excess(const Twist<V>& twist, const V& dt2) const {
      const V way = dot(twist.linear, twist.linear) * dt2 - way2;
      const V turn = dot(twist.angular, twist.angular) * dt2 - turn2;
      return T::max(way, turn);
    }
  };
  std::vector<Slot> slots_;
};

template <class T>
SpeedBounds<T>::SpeedBounds(const WorldLanes<T>& worlds, std::span<const PackedWorld> packed) {
  const V none = T::broadcast(static_cast<Scalar>(model::infinity));
  slots_.assign(static_cast<std::size_t>(worlds.places.num_slots()), {none, none});
  for (int world = 0; world < worlds.num_worlds(); ++world) {
    const std::vector<effects::SlowBound> bounds =
        effects::slow_bounds(worlds.model(world), packed[static_cast<std::size_t>(world)].most_approach_m);
    for (std::size_t body = 0; body < bounds.size(); ++body) {
      const auto [way, turn] = bounds[body];
      const LanePlace at = worlds.places.body(world, static_cast<int>(body));
      Slot& slot = slots_[static_cast<std::size_t>(at.slot)];
      T::set(slot.way2, at.lane, static_cast<Scalar>(way * way));
      T::set(slot.turn2, at.lane, static_cast<Scalar>(turn * turn));
    }
  }
}

/// Most steps have no fast body: they go over the slots once, without a branch.
template <class T>
void SpeedBounds<T>::find_fast(const WorldLanes<T>& worlds, double dt_s,
                               std::vector<char>& may_be_fast) const {
  const V dt2 = T::broadcast(static_cast<Scalar>(dt_s * dt_s));
  const Twist<V>* twists = worlds.bodies.twists.data();
  const V zero = T::broadcast(0);
  V most = zero;
  for (std::size_t slot = 0; slot < slots_.size(); ++slot)
    most = T::max(slots_[slot].excess(twists[slot], dt2), most);
  if (!T::any(most)) return;
  for (std::size_t slot = 0; slot < slots_.size(); ++slot)
    mark_worlds<T>(worlds.places, static_cast<int>(slot),
                   T::max(slots_[slot].excess(twists[slot], dt2), zero), may_be_fast);
}

/// Sets may_be_slow[num_worlds], initially 0, where the centre of a body moves by at most `way_m` in a step
/// of `dt_s`, or rounding in its lane leaves it open.
template <class T>
void find_slow(const WorldLanes<T>& worlds, double dt_s, double way_m, std::vector<char>& may_be_slow) {
  using V = typename T::V;
  using Scalar = typename T::Scalar;
  const V zero = T::broadcast(0), one = T::broadcast(1);
  const double speed = way_m / dt_s;
  const V square = T::broadcast(static_cast<Scalar>(speed * speed * 1.001));  // leaves room for rounding
  for (int slot = 0; slot < worlds.places.num_slots(); ++slot) {
    const Twist<V>& twist = worlds.bodies.twists[slot];
    const V is_slow = dot(twist.linear, twist.linear) <= square ? one : zero;
    mark_worlds<T>(worlds.places, slot, is_slow, may_be_slow);
  }
}

}  // namespace pbmpi::solver
