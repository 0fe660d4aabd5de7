/// The rows of a joint that hold its bodies together, as plain matrices for an exact solve.
#pragma once

#include "solver/joints/joint_rows.h"

namespace pbmpi::solver {

/// Number of rows of a joint without its limits and motors.
constexpr int num_held_rows(model::JointKind kind) {
  const RowCounts counts = row_counts(kind);
  return 3 * counts.points + counts.lines + counts.axes;
}

/// Jacobians of the rows with respect to the twists of the two bodies, linear components first. Rows of
/// broken joints, which have no scale, are empty.
template <class T>
struct alignas(sizeof(typename T::V)) JointJacobian {
  using V = typename T::V;
  V a[6][6], b[6][6];
  V cfm[6];    ///< of each row
  V holds[6];  ///< 1 where a row holds, else 0
};

namespace jacobian_detail {

template <class T>
PBMPI_LANES void set_row(const Vec3L<typename T::V>& linear, const Vec3L<typename T::V>& moment_a,
                         const Vec3L<typename T::V>& moment_b, const typename T::V& scale,
                         const typename T::V& cfm, int row, JointJacobian<T>& jacobian) {
  using V = typename T::V;
  const V zero = T::broadcast(0), one = T::broadcast(1);
  const V holds = scale > zero ? one : zero;
  const V to_a[6] = {linear.x, linear.y, linear.z, moment_a.x, moment_a.y, moment_a.z};
  const V to_b[6] = {-linear.x, -linear.y, -linear.z, moment_b.x, moment_b.y, moment_b.z};
  for (int i = 0; i < 6; ++i) {
    jacobian.a[row][i] = to_a[i] * holds;
    jacobian.b[row][i] = to_b[i] * holds;
  }
  jacobian.cfm[row] = cfm;
  jacobian.holds[row] = holds;
}

}  // namespace jacobian_detail

/// `cfm` [s/kg]: the joints' CFM divided by the step.
template <class T, model::JointKind kind>
PBMPI_LANES void set_jacobian(const JointRows<T, kind>& rows, typename T::Scalar cfm,
                              JointJacobian<T>& jacobian) {
  using V = typename T::V;
  using jacobian_detail::set_row;
  const V zero = T::broadcast(0), one = T::broadcast(1), own_cfm = T::broadcast(cfm);
  const Vec3L<V> none{zero, zero, zero};
  int row = 0;
  for (const PointRows<V>& point : rows.points) {
    const Vec3L<V>&ra = point.arm_a, &rb = point.arm_b;
    set_row<T>({one, zero, zero}, {zero, ra.z, -ra.y}, {zero, -rb.z, rb.y}, point.scale.x, own_cfm, row++,
               jacobian);
    set_row<T>({zero, one, zero}, {-ra.z, zero, ra.x}, {rb.z, zero, -rb.x}, point.scale.y, own_cfm, row++,
               jacobian);
    set_row<T>({zero, zero, one}, {ra.y, -ra.x, zero}, {-rb.y, rb.x, zero}, point.scale.z, own_cfm, row++,
               jacobian);
  }
  for (const LineRow<V>& line : rows.lines)
    set_row<T>(line.direction, line.moment_a, line.moment_b, line.scale, line.cfm, row++, jacobian);
  for (const AxisRow<V>& axis : rows.axes)
    set_row<T>(none, axis.axis, -axis.axis, axis.scale, own_cfm, row++, jacobian);
}

/// Calls visit(row, right-hand side times `bias`, impulse) for each row; a suspension keeps its whole
/// right-hand side.
template <class T, model::JointKind kind, class Visit>
PBMPI_LANES void for_each_held_row(JointRows<T, kind>& rows, typename T::Scalar bias, Visit visit) {
  using V = typename T::V;
  int row = 0;
  for (PointRows<V>& point : rows.points) {
    visit(row++, point.rhs.x * bias, point.impulse.x);
    visit(row++, point.rhs.y * bias, point.impulse.y);
    visit(row++, point.rhs.z * bias, point.impulse.z);
  }
  for (std::size_t i = 0; i < rows.lines.size(); ++i) {
    const bool springs = rows.sprung && i == 0;
    visit(row++, springs ? rows.lines[i].rhs : rows.lines[i].rhs * bias, rows.lines[i].impulse);
  }
  for (AxisRow<V>& axis : rows.axes) visit(row++, axis.rhs * bias, axis.impulse);
}

}  // namespace pbmpi::solver
