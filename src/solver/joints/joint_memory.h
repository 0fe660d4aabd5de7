/// What a joint's rows take over from the previous step, and leave to the next.
#pragma once

#include <cstddef>

#include "solver/joints/joint_rows.h"
#include "solver/joints/joint_terms.h"

namespace pbmpi::solver {

/// Sets the impulses of rows that have just been built: the components of the remembered forces along their
/// directions, times `h`, the length of a substep or a share of it. Limits and motors stay within their
/// bounds.
template <class T, model::JointKind kind>
PBMPI_LANES void recall_forces(const JointForceLane<typename T::V>& memory, const typename T::V& h,
                               JointRows<T, kind>& rows) {
  for (auto& row : rows.points) row.impulse = memory.force * h;
  for (auto& row : rows.lines) row.impulse = dot(row.direction, memory.force) * h;
  for (auto& row : rows.axes) row.impulse = dot(row.axis, memory.torque) * h;
  const auto recall_control = [&](auto& controls) {
    for (std::size_t i = 0; i < controls.size(); ++i) {
      if (!rows.control_on[i]) continue;
      auto& control = controls[i];
      control.row.impulse = T::min(T::max(memory.control[i] * h, control.low), control.high);
    }
  };
  recall_control(rows.axis_controls);
  recall_control(rows.line_controls);
}

/// Remembers the forces of rows as last solved; `per_h`: 1 / h. `keeps`: null, or 1 in the lanes whose memory
/// stays as it is. A row that no lane has leaves +0, as in a lane without that row.
template <class T, model::JointKind kind>
PBMPI_LANES void remember_forces(const JointRows<T, kind>& rows, const typename T::V& per_h,
                                 const typename T::V* keeps, JointForceLane<typename T::V>& memory) {
  using V = typename T::V;
  const V zero = T::broadcast(0);
  JointForceLane<V> now;
  for (const auto& row : rows.points) now.force = row.impulse;
  for (const auto& row : rows.lines) now.force = now.force + row.direction * row.impulse;
  for (const auto& row : rows.axes) now.torque = now.torque + row.axis * row.impulse;
  const auto remember_control = [&](const auto& controls) {
    for (std::size_t i = 0; i < controls.size(); ++i) {
      if (rows.control_on[i]) now.control[i] = controls[i].row.impulse + zero;
    }
  };
  remember_control(rows.axis_controls);
  remember_control(rows.line_controls);
  const auto put = [&](const V& value, V& to) {
    const V force = value * per_h;
    to = keeps == nullptr ? force : (*keeps > zero ? to : force);
  };
  put(now.force.x, memory.force.x);
  put(now.force.y, memory.force.y);
  put(now.force.z, memory.force.z);
  put(now.torque.x, memory.torque.x);
  put(now.torque.y, memory.torque.y);
  put(now.torque.z, memory.torque.z);
  put(now.control[0], memory.control[0]);
  put(now.control[1], memory.control[1]);
}

}  // namespace pbmpi::solver
