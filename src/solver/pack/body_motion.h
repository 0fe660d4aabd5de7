/// Forces on the bodies of a pack, and their motion.
#pragma once

#include <algorithm>

#include "core/elementary.h"
#include "solver/layout/pack_laws.h"
#include "solver/pack/world_lanes.h"

namespace pbmpi::solver {

/// Works batch by batch. `h` [s]: length of a substep; `dt` [s]: length of the step.
template <class T>
class BodyMotion {
 public:
  using V = typename T::V;
  using Scalar = typename T::Scalar;
  using Batch = typename JointBatches<T>::Batch;

  /// `worlds` is borrowed.
  BodyMotion(const PackLaws& laws, WorldLanes<T>& worlds)
      : linear_damping_(laws.linear_damping), angular_damping_(laws.angular_damping), worlds_(worlds) {}

  void apply_gyroscopic_torques(const Batch& batch, Scalar dt, const GyroscopicSlot<V>*& next);
  /// Gravity and loads.
  void apply_gravity(const Batch& batch, Scalar h);
  /// Expects the bodies to move with their present twists: sets BodyLanes::expected and half_turnings.
  /// `next`: as above, or null where bodies turn without the torque.
  void look_ahead(const Batch& batch, Scalar h, const GyroscopicSlot<V>*& next);
  /// `last`: the step ends here. `exact`: 1 in the lanes whose joints are solved exactly, else 0. `next`: as
  /// above, or null where bodies turn without the torque.
  template <bool last>
  void move(const Batch& batch, Scalar h, const V& exact, const GyroscopicSlot<V>*& next);
  void damp(const Batch& batch, double h);

 private:
  /// Moves `next` to the first slot with the torque from the batch on; returns the end of all.
  const GyroscopicSlot<V>* find_turning(const Batch& batch, const GyroscopicSlot<V>*& next) const {
    const GyroscopicSlot<V>* const end = worlds_.gyroscopic.data() + worlds_.gyroscopic.size();
    if (next != end && next->slot < batch.first_slot)
      next = std::ranges::lower_bound(next, end, batch.first_slot, {}, &GyroscopicSlot<V>::slot);
    return end;
  }

  double linear_damping_, angular_damping_;  ///< [1/s]
  WorldLanes<T>& worlds_;
};

/// `next`: the first slot with the torque that no earlier batch had; advances to that of the next batch.
template <class T>
void BodyMotion<T>::apply_gyroscopic_torques(const Batch& batch, Scalar dt, const GyroscopicSlot<V>*& next) {
  const GyroscopicSlot<V>* const end = find_turning(batch, next);
  for (; next != end && next->slot < batch.end_slot; ++next)
    apply_gyroscopic_torque<T>(worlds_.bodies.bodies[next->slot], next->has_torque,
                               worlds_.bodies.twists[next->slot], dt);
}

template <class T>
void BodyMotion<T>::apply_gravity(const Batch& batch, Scalar h) {
  for (int slot = batch.first_slot; slot < batch.end_slot; ++slot) {
    Twist<V>& twist = worlds_.bodies.twists[slot];
    twist.linear = twist.linear + worlds_.gravity[slot] * T::broadcast(h);
  }
  if (worlds_.torque.empty()) return;
  for (int slot = batch.first_slot; slot < batch.end_slot; ++slot) {
    const Vec3L<V>& torque = worlds_.torque[slot];
    const V acts = dot(torque, torque), none = T::broadcast(0);
    if (!T::any(acts)) continue;
    Vec3L<V>& angular = worlds_.bodies.twists[slot].angular;
    const Vec3L<V> turned = angular + worlds_.bodies.bodies[slot].inv_inertia * torque * T::broadcast(h);
    // A sum with 0 would change -0 in the other lanes.
    angular = {acts > none ? turned.x : angular.x, acts > none ? turned.y : angular.y,
               acts > none ? turned.z : angular.z};
  }
}

template <class T>
void BodyMotion<T>::look_ahead(const Batch& batch, Scalar h, const GyroscopicSlot<V>*& next) {
  if (!batch.has_joints) return;
  BodyLanes<T>& bodies = worlds_.bodies;
  for (int slot = batch.first_slot; slot < batch.end_slot; ++slot)
    bodies.expected[slot] = bodies.twists[slot];
  if (next == nullptr) return;
  const GyroscopicSlot<V>* const end = find_turning(batch, next);
  for (; next != end && next->slot < batch.end_slot; ++next)
    bodies.half_turnings[next->slot] = half_turning<T>(bodies.bodies[next->slot], next->has_torque,
                                                       bodies.expected[next->slot].angular, h / 2);
}

template <class T>
template <bool last>
void BodyMotion<T>::move(const Batch& batch, Scalar h, const V& exact, const GyroscopicSlot<V>*& next) {
  const GyroscopicSlot<V>* const end = next == nullptr ? nullptr : find_turning(batch, next);
  for (int slot = batch.first_slot; slot < batch.end_slot; ++slot) {
    BodyLane<V>& body = worlds_.bodies.bodies[slot];
    Twist<V>& twist = worlds_.bodies.twists[slot];
    while (next != nullptr && next != end && next->slot < slot) ++next;
    if (next != nullptr && next != end && next->slot == slot) {
      integrate_turning<T, last>(next->inertia, h, next->has_torque, exact, body, twist);
    } else {
      integrate<T, last>(body, twist, h);
      body.rotation = to_matrix(body.qw, body.qx, body.qy, body.qz);
    }
    refresh_inertia(body);
  }
}

/// Like ODE after it has moved a body: v <- (1 - scale) v. The scale of a step of any length is that of an
/// exponential decay.
template <class T>
void BodyMotion<T>::damp(const Batch& batch, double h) {
  const V linear = T::broadcast(static_cast<Scalar>(core::exponential(-linear_damping_ * h)));
  const V angular = T::broadcast(static_cast<Scalar>(core::exponential(-angular_damping_ * h)));
  for (int slot = batch.first_slot; slot < batch.end_slot; ++slot) {
    Twist<V>& twist = worlds_.bodies.twists[slot];
    twist = {twist.linear * linear, twist.angular * angular};
  }
}

}  // namespace pbmpi::solver
