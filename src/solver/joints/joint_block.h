/// The rows of a joint as one block: what an impulse along each row makes of the others.
#pragma once

#include "solver/joints/joint_points.h"
#include "solver/joints/joint_rows.h"

namespace pbmpi::solver {

/// J M^-1 J^T + cfm over the rows of a joint, in the order of JointRows::block; `cfm` [s/kg]: divided by the
/// step, of all rows but lines, which have their own.
template <class T, model::JointKind kind>
class alignas(sizeof(typename T::V)) JointBlock {
 public:
  using V = typename T::V;
  using Rows = JointRows<T, kind>;
  static constexpr int num_rows = Rows::counts.all();

  /// Sets JointRows::block.
  PBMPI_LANES static void factor(Rows& rows, typename T::Scalar cfm) {
    JointBlock block(rows, cfm);
    for (const PointRows<V>& point : rows.points) block.add(point);
    for (const LineRow<V>& line : rows.lines) block.add(line);
    for (const AxisRow<V>& axis : rows.axes) block.add(axis);
    rows.has_block = true;
    if (!rows.acts()) {
      rows.block.template eliminate<Rows::counts.held(), Rows::counts.held()>(block.matrix_);
      return;
    }
    for_each_control(rows, [&](const auto& control, std::size_t) { block.add(control.row); });
    rows.block.template eliminate<Rows::counts.held()>(block.matrix_);
  }

 private:
  JointBlock(const Rows& rows, typename T::Scalar cfm)
      : masses_(rows.inv_mass_a + rows.inv_mass_b), cfm_(T::broadcast(cfm)) {}

  /// Adds a row with the angular parts of its Jacobian and of its response; `on_itself`: its own response
  /// less these. Vector by vector: g++ copies larger structs by slow string instructions.
  PBMPI_LANES void add(const Vec3L<V>& moment_a, const Vec3L<V>& moment_b, const Vec3L<V>& turn_a,
                       const Vec3L<V>& turn_b, const V& on_itself) {
    turn_a_[count_] = turn_a;
    turn_b_[count_] = turn_b;
    for (int other = 0; other <= count_; ++other)
      matrix_[count_][other] = dot(moment_a, turn_a_[other]) + dot(moment_b, turn_b_[other]);
    matrix_[count_][count_] += on_itself;
    ++count_;
  }
  PBMPI_LANES void add(const PointRows<V>& point) {
    const V zero = T::broadcast(0), own = masses_ + cfm_;
    const Vec3L<V>&ra = point.arm_a, &rb = point.arm_b;
    add({zero, ra.z, -ra.y}, {zero, -rb.z, rb.y}, point.turn_a[0], -point.turn_b[0], own);
    add({-ra.z, zero, ra.x}, {rb.z, zero, -rb.x}, point.turn_a[1], -point.turn_b[1], own);
    add({ra.y, -ra.x, zero}, {-rb.y, rb.x, zero}, point.turn_a[2], -point.turn_b[2], own);
  }
  /// The lines of a joint are at right angles, so that they couple by turning alone.
  PBMPI_LANES void add(const LineRow<V>& line) {
    add(line.moment_a, line.moment_b, line.turn_a, line.turn_b, masses_ + line.cfm);
  }
  PBMPI_LANES void add(const AxisRow<V>& axis) {
    add(axis.axis, -axis.axis, axis.turn_a, -axis.turn_b, cfm_);
  }

  V masses_, cfm_;
  int count_ = 0;
  Vec3L<V> turn_a_[num_rows], turn_b_[num_rows];
  V matrix_[num_rows][num_rows];
};

}  // namespace pbmpi::solver
