/// The rows of a joint as plain matrices for an exact solve.
#pragma once

#include "solver/joints/joint_rows.h"

namespace pbmpi::solver {

/// Jacobians of the rows with respect to the twists of the two bodies, linear components first, in the order
/// of JointRows::block. Rows of limits and motors stand for the rotors of their axes, and are empty where
/// there is none, as are all rows of broken joints.
template <class T>
struct alignas(sizeof(typename T::Wide::V)) JointJacobian {
  using V = typename T::Wide::V;
  V a[6][6], b[6][6];
  V cfm[6];    ///< of each row
  V holds[6];  ///< 1 where a row holds, else 0
};

namespace jacobian_detail {

template <class T>
PBMPI_LANES void set_row(const Vec3L<typename T::V>& linear, const Vec3L<typename T::V>& moment_a,
                         const Vec3L<typename T::V>& moment_b, const typename T::V& holds,
                         const typename T::V& cfm, int row, JointJacobian<T>& jacobian) {
  using V = typename T::V;
  const V to_a[6] = {linear.x, linear.y, linear.z, moment_a.x, moment_a.y, moment_a.z};
  const V to_b[6] = {-linear.x, -linear.y, -linear.z, moment_b.x, moment_b.y, moment_b.z};
  for (int i = 0; i < 6; ++i) {
    jacobian.a[row][i] = T::widen(to_a[i] * holds);
    jacobian.b[row][i] = T::widen(to_b[i] * holds);
  }
  jacobian.cfm[row] = T::widen(cfm);
  jacobian.holds[row] = T::widen(holds);
}
template <class T>
PBMPI_LANES void set_row(const LineRow<typename T::V>& line, const typename T::V& holds,
                         const typename T::V& cfm, int row, JointJacobian<T>& jacobian) {
  set_row<T>(line.direction, line.moment_a, line.moment_b, holds, cfm, row, jacobian);
}
template <class T>
PBMPI_LANES void set_row(const AxisRow<typename T::V>& axis, const typename T::V& holds,
                         const typename T::V& cfm, int row, JointJacobian<T>& jacobian) {
  const typename T::V zero = T::broadcast(0);
  set_row<T>({zero, zero, zero}, axis.axis, -axis.axis, holds, cfm, row, jacobian);
}

}  // namespace jacobian_detail

/// `cfm` [s/kg]: the joints' CFM divided by the step.
template <class T, model::JointKind kind>
PBMPI_LANES void set_jacobian(const JointRows<T, kind>& rows, typename T::Scalar cfm,
                              JointJacobian<T>& jacobian) {
  using V = typename T::V;
  using jacobian_detail::set_row;
  const V zero = T::broadcast(0), one = T::broadcast(1), own_cfm = T::broadcast(cfm);
  int row = 0;
  for (const PointRows<V>& point : rows.points) {
    const Vec3L<V>&ra = point.arm_a, &rb = point.arm_b;
    set_row<T>({one, zero, zero}, {zero, ra.z, -ra.y}, {zero, -rb.z, rb.y}, rows.holds, own_cfm, row++,
               jacobian);
    set_row<T>({zero, one, zero}, {-ra.z, zero, ra.x}, {rb.z, zero, -rb.x}, rows.holds, own_cfm, row++,
               jacobian);
    set_row<T>({zero, zero, one}, {ra.y, -ra.x, zero}, {-rb.y, rb.x, zero}, rows.holds, own_cfm, row++,
               jacobian);
  }
  for (const LineRow<V>& line : rows.lines) set_row<T>(line, rows.holds, line.cfm, row++, jacobian);
  for (const AxisRow<V>& axis : rows.axes) set_row<T>(axis, rows.holds, own_cfm, row++, jacobian);
  if (!rows.has_rotors) return;
  for_each_control(rows, [&](const auto& control, std::size_t) {
    const auto turns = control.rotor.inertia > zero;
    const V cfm_of_rotor = 1 / (turns ? control.rotor.inertia : one);
    set_row<T>(control.row, turns ? rows.holds : zero, cfm_of_rotor, row++, jacobian);
  });
}

}  // namespace pbmpi::solver
