/// What a joint's rows take over from the previous step, and leave to the next.
#pragma once

#include <cstddef>

#include "solver/joints/joint_rows.h"
#include "solver/joints/joint_terms.h"

namespace pbmpi::solver {

/// Sets the impulses of rows that have just been built: the components of these forces along their
/// directions, times `h`, the length of a substep or a share of it. Limits and motors stay within their
/// bounds.
template <class T, model::JointKind kind>
PBMPI_LANES void recall_forces(const JointForceLane<typename T::V>& memory, const typename T::V& h,
                               JointRows<T, kind>& rows) {
  using V = typename T::V;
  const V zero = T::broadcast(0), share = h * rows.holds;
  for (auto& row : rows.points) row.impulse = memory.force * share;
  for (auto& row : rows.lines) row.impulse = dot(row.direction, memory.force) * share;
  for (auto& row : rows.axes) row.impulse = dot(row.axis, memory.torque) * share;
  for_each_control(rows, [&](auto& control, std::size_t i) {
    control.row.impulse =
        rows.control_on[i] ? T::min(T::max(memory.control[i] * share, control.low), control.high) : zero;
    control.rotor.impulse = memory.rotor[i] * share;
  });
}

/// Sets the forces of rows as last solved; `per_h`: 1 / h. A row that no lane has leaves +0, as in a lane
/// without that row.
template <class T, model::JointKind kind>
PBMPI_LANES void set_forces(const JointRows<T, kind>& rows, const typename T::V& per_h,
                            JointForceLane<typename T::V>& now) {
  using V = typename T::V;
  const V zero = T::broadcast(0);
  for (const auto& row : rows.points) now.force = row.impulse;
  for (const auto& row : rows.lines) now.force = now.force + row.direction * row.impulse;
  for (const auto& row : rows.axes) now.torque = now.torque + row.axis * row.impulse;
  now.force = now.force * per_h;
  now.torque = now.torque * per_h;
  for_each_control(rows, [&](const auto& control, std::size_t i) {
    if (rows.control_on[i]) now.control[i] = (control.row.impulse + zero) * per_h;
    if (rows.has_rotors) now.rotor[i] = (control.rotor.impulse + zero) * per_h;
  });
}

/// Remembers the forces of rows as last solved, and the angles of a joint's axes. `keeps`: null, or 1 in the
/// lanes whose memory stays as it is.
template <class T, model::JointKind kind>
PBMPI_LANES void remember_forces(const JointRows<T, kind>& rows, const typename T::V& per_h,
                                 const typename T::V* keeps, JointLane<typename T::V>& joint) {
  using V = typename T::V;
  const V zero = T::broadcast(0);
  JointForceLane<V> now;
  set_forces<T>(rows, per_h, now);
  for (int axis = 0; axis < 2; ++axis) now.angle[axis] = joint.controls[axis].angle;
  const auto* from = reinterpret_cast<const V*>(&now);
  auto* to = reinterpret_cast<V*>(&joint.memory);
  for (std::size_t i = 0; i < sizeof now / sizeof(V); ++i)
    to[i] = keeps == nullptr ? from[i] : (*keeps > zero ? to[i] : from[i]);
}

}  // namespace pbmpi::solver
