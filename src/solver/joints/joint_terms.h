/// The data from which a joint's rows are built, in lanes: the same joint of up to `num_lanes` articulations.
#pragma once

#include "solver/lanes/lanes.h"
#include "solver/layout/articulation.h"

namespace pbmpi::solver {

/// Limit and motor of one axis: they may differ from lane to lane and change by events.
template <class V>
struct alignas(sizeof(V)) AxisControl {
  V low, high;               ///< [rad] or [m]; +-huge = none
  V sin_middle, cos_middle;  ///< of half the angle in the middle of the range
  V middle;                  ///< [rad]
  V counts;  ///< 1 where turns are counted: the range alone does not tell which of them it is, else 0
  V velocity, max_force, hold_rate;
  V armature;  ///< [kg m^2] or [kg]
  V angle{};   ///< [rad] with its turns, where they are counted
  bool has_motor = false, has_limit = false, has_hold = false;  ///< in any lane
  bool has_rotor = false, counts_turns = false;                 ///< likewise
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
  V control[2]{}, rotor[2]{}, angle[2]{};
};

/// One joint of a batch.
template <class V>
struct alignas(sizeof(V)) JointLane {
  int slot_a = 0, slot_b = 0;
  bool sprung = false;  ///< hinge2 with a suspension spring
  V holds;              ///< 1, or 0 in the lanes whose joint is broken
  JointTermsLane<V> terms;
  AxisControl<V> controls[2];
  JointForceLane<V> memory;  ///< forces with which the last step ended
};

}  // namespace pbmpi::solver
