/// The data from which a joint's rows are built, in lanes: the same joint of up to `num_lanes` articulations.
#pragma once

#include "solver/lanes/lanes.h"
#include "solver/layout/articulation.h"

namespace pbmpi::solver {

/// Limit and motor of one axis: they may differ from lane to lane and change by events.
template <class V>
struct alignas(sizeof(V)) AxisControl {
  V low, high;                             ///< [rad] or [m]; +-huge = none
  V sin_low, cos_low, sin_high, cos_high;  ///< sines and cosines of half the limit angles
  V velocity, max_force, hold_rate;
  V place{};  ///< [rad] or [m] the joint's coordinate along this axis, updated each substep
  bool has_motor = false, has_limit = false, has_hold = false;  ///< in any lane

  bool any() const { return has_motor || has_limit; }
  /// Does a limit or a motor need `place`?
  bool is_placed() const { return has_limit || has_hold; }
};

template <class V>
struct alignas(sizeof(V)) JointTermsLane {
  Vec3L<V> anchor_a, anchor_b, axis1_a, axis1_b, axis2_b, normal1_a, normal2_b;
  V relative_w, relative_x, relative_y, relative_z;
  V cos0, sin0, stiffness, damping;
};

/// model::JointForce in lanes.
template <class V>
struct alignas(sizeof(V)) JointForceLane {
  Vec3L<V> force{}, torque{};
  V control[2]{};
};

/// One joint of a batch.
template <class V>
struct alignas(sizeof(V)) JointLane {
  int slot_a = 0, slot_b = 0;
  bool sprung = false;  ///< hinge2 with a suspension spring
  JointTermsLane<V> terms;
  AxisControl<V> controls[2];
  JointForceLane<V> memory;  ///< forces with which the last step ended
};

}  // namespace pbmpi::solver
