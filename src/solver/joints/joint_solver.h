/// Sweeps over joints, each solved as a block of all its rows.
#pragma once

#include <cstddef>

#include "solver/joints/joint_block.h"
#include "solver/joints/joint_rows.h"
#include "solver/layout/row_law.h"

namespace pbmpi::solver {

/// The laws of a sweep over joints: one for rows that hold a place, one for rows that hold an orientation and
/// for limits.
template <class Scalar>
struct JointLaws {
  RowLaw<Scalar> places, turns;
  Scalar exact_bias = 1;  ///< RowLaw::bias of rows solved exactly, which have no relief

  static JointLaws relaxing() { return {RowLaw<Scalar>::relaxing(), RowLaw<Scalar>::relaxing(), 0}; }
};

/// ERP of the rows of JointLaws, in a substep.
template <class Scalar>
struct JointErp {
  Scalar places = 0, turns = 0;
};

/// Calls visit(index, right-hand side, ahead, CFM, impulse, law) for each row of a joint without its limits
/// and motors, in the order of JointRows::block. A suspension has its own spring in all sweeps.
template <class T, model::JointKind kind, class Visit>
PBMPI_LANES void for_each_held_row(JointRows<T, kind>& rows, const JointLaws<typename T::Scalar>& laws,
                                   typename T::Scalar cfm, Visit visit) {
  using V = typename T::V;
  using Law = RowLaw<typename T::Scalar>;
  const V own_cfm = T::broadcast(cfm);
  int index = 0;
  for (PointRows<V>& point : rows.points) {
    visit(index++, point.rhs.x, point.ahead.x, own_cfm, point.impulse.x, laws.places);
    visit(index++, point.rhs.y, point.ahead.y, own_cfm, point.impulse.y, laws.places);
    visit(index++, point.rhs.z, point.ahead.z, own_cfm, point.impulse.z, laws.places);
  }
  for (std::size_t i = 0; i < rows.lines.size(); ++i) {
    LineRow<V>& line = rows.lines[i];
    visit(index++, line.rhs, line.ahead, line.cfm, line.impulse, rows.sprung && i == 0 ? Law{} : laws.places);
  }
  for (AxisRow<V>& axis : rows.axes) visit(index++, axis.rhs, axis.ahead, own_cfm, axis.impulse, laws.turns);
}

/// A block step on the rows of a joint. One row after the other they would contract the more slowly the
/// longer its levers are beside the bodies' radii of gyration, and a memory of impulses lets grow what a
/// sweep does not contract.
template <class T>
class JointSolver {
 public:
  using V = typename T::V;
  using Scalar = typename T::Scalar;
  using Laws = JointLaws<Scalar>;

  /// `cfm` [s/kg]: the joints' CFM divided by the step; `laws`: those of this sweep.
  JointSolver(Scalar cfm, Scalar sor_factor, const Laws& laws)
      : cfm_(cfm), factor_(sor_factor), laws_(laws) {}

  const Laws& laws() const { return laws_; }
  Scalar cfm() const { return cfm_; }

  /// `where`: 1 in the lanes to be solved, else 0.
  template <model::JointKind kind>
  PBMPI_LANES void solve(JointRows<T, kind>& rows, const V& where, BodyLanes<T>& bodies) const {
    constexpr int num_held = JointRows<T, kind>::counts.held(), num_rows = JointRows<T, kind>::counts.all();
    if (!rows.has_block) JointBlock<T, kind>::factor(rows, cfm_);
    Twist<V> a = bodies.twists[rows.slot_a], b = bodies.twists[rows.slot_b];
    V change[num_rows];
    set_errors(rows, a, b, change);
    const bool acts = num_rows > num_held && rows.acts();
    if (acts) {
      rows.block.template forward<num_held, num_rows>(change);
      if constexpr (num_rows > num_held) solve_controls(rows, where, change);
    } else {
      rows.block.template forward<num_held>(change);
    }
    for (int i = num_held; i-- > 0;) {
      rows.block.back(i, num_held, change);
      for (int k = num_held; acts && k < num_rows; ++k)
        change[i] = after(change[i], rows.block.lower[k][i] * -change[k], change[k]);
    }
    const V holds = rows.holds * where, zero = T::broadcast(0);
    for_each_held_row(
        rows, laws_, cfm_, [&](int i, const V&, const V&, const V&, V& impulse, const RowLaw<Scalar>& law) {
          change[i] = (change[i] * T::broadcast(law.mass_share * factor_) - law.relief * impulse) * holds;
          impulse = holds > zero ? impulse + change[i] : impulse;
        });
    push_held(rows, change, a, b);
    if (acts) {
      const Twist<V> before_a = a, before_b = b;
      for_each_control(rows, [&](const auto& control, std::size_t i) {
        push(rows, control.row, change[num_held + static_cast<int>(i)], a, b);
      });
      const V one = T::broadcast(1);
      V pushed = zero;
      for (int k = num_held; k < num_rows; ++k) pushed = change[k] != zero ? one : pushed;
      keep_where_zero(pushed, before_a, a);
      keep_where_zero(pushed, before_b, b);
    }
    keep_where_zero(where, bodies.twists[rows.slot_a], a);
    keep_where_zero(where, bodies.twists[rows.slot_b], b);
    bodies.twists[rows.slot_a] = a;
    bodies.twists[rows.slot_b] = b;
  }

  /// A motor at its limit acts as an external torque (ODE: dxJointLimitMotor::addLimot).
  template <model::JointKind kind>
  PBMPI_LANES static void push_motors(const JointRows<T, kind>& rows, BodyLanes<T>& bodies) {
    Twist<V>&a = bodies.twists[rows.slot_a], &b = bodies.twists[rows.slot_b];
    for_each_control(rows, [&](const auto& control, std::size_t axis) {
      if (rows.control_on[axis]) push(rows, control.row, -control.push, a, b);
    });
  }

  /// Applies the impulses with which the rows start to the bodies.
  template <model::JointKind kind>
  PBMPI_LANES static void push_carried(const JointRows<T, kind>& rows, BodyLanes<T>& bodies) {
    Twist<V> a = bodies.twists[rows.slot_a], b = bodies.twists[rows.slot_b];
    for (const PointRows<V>& row : rows.points) push(rows, row, row.impulse, a, b);
    for (const auto& row : rows.lines) push(rows, row, row.impulse, a, b);
    for (const auto& row : rows.axes) push(rows, row, row.impulse, a, b);
    for_each_control(rows, [&](const auto& control, std::size_t axis) {
      if (rows.control_on[axis]) push(rows, control.row, control.row.impulse, a, b);
      if (rows.has_rotors) push(rows, control.row, control.rotor.impulse, a, b);
    });
    bodies.twists[rows.slot_a] = a;
    bodies.twists[rows.slot_b] = b;
  }

  /// Lets rotors begin a substep at the present speed of their coordinates.
  template <model::JointKind kind>
  PBMPI_LANES static void start_rotors(JointRows<T, kind>& rows, const BodyLanes<T>& bodies) {
    if (!rows.has_rotors) return;
    for_each_control(rows, [&](auto& control, std::size_t) {
      control.rotor.start = speed(control.row, bodies.twists[rows.slot_a], bodies.twists[rows.slot_b]);
    });
  }

  PBMPI_LANES static V speed(const AxisRow<V>& row, const Twist<V>& a, const Twist<V>& b) {
    return dot(row.axis, a.angular - b.angular);
  }
  PBMPI_LANES static V speed(const LineRow<V>& row, const Twist<V>& a, const Twist<V>& b) {
    return relative_speed(row, a, b);
  }
  /// The impulse `change` acts on the bodies of a row.
  template <class Rows>
  PBMPI_LANES static void push(const Rows&, const AxisRow<V>& row, const V& change, Twist<V>& a,
                               Twist<V>& b) {
    a.angular = a.angular + row.turn_a * change;
    b.angular = b.angular - row.turn_b * change;
  }
  template <class Rows>
  PBMPI_LANES static void push(const Rows& rows, const LineRow<V>& row, const V& change, Twist<V>& a,
                               Twist<V>& b) {
    apply(row, change, rows.inv_mass_a, a);
    apply_to_b(row, change, rows.inv_mass_b, b);
  }
  template <class Rows>
  PBMPI_LANES static void push(const Rows& rows, const PointRows<V>& row, const Vec3L<V>& change, Twist<V>& a,
                               Twist<V>& b) {
    a.linear = a.linear + change * rows.inv_mass_a;
    b.linear = b.linear - change * rows.inv_mass_b;
    a.angular = a.angular + row.turn_a[0] * change.x + row.turn_a[1] * change.y + row.turn_a[2] * change.z;
    b.angular = b.angular - row.turn_b[0] * change.x - row.turn_b[1] * change.y - row.turn_b[2] * change.z;
  }

 private:
  /// A motor keeps its target velocity in all sweeps.
  template <class Row>
  PBMPI_LANES V rhs_of(const Bounded<Row, V>& control) const {
    return laws_.turns.bias > 0 ? control.row.rhs : control.relaxed_rhs;
  }
  PBMPI_LANES V cfm_of(const AxisRow<V>&) const { return T::broadcast(cfm_); }
  PBMPI_LANES V cfm_of(const LineRow<V>& row) const { return row.cfm; }
  /// sum + change, or the same sum to the bit, -0 included, where an impulse is 0: a lane in which nothing
  /// acts is not to notice that something does in another.
  PBMPI_LANES static V after(const V& sum, const V& change, const V& impulse) {
    return impulse != T::broadcast(0) ? sum + change : sum;
  }
  PBMPI_LANES static void keep_where_zero(const V& pushed, const Twist<V>& before, Twist<V>& now) {
    const auto is_pushed = pushed > T::broadcast(0);
    const auto keep = [&](const Vec3L<V>& from, Vec3L<V>& to) {
      to.x = is_pushed ? to.x : from.x;
      to.y = is_pushed ? to.y : from.y;
      to.z = is_pushed ? to.z : from.z;
    };
    keep(before.linear, now.linear);
    keep(before.angular, now.angular);
  }
  template <model::JointKind kind>
  PBMPI_LANES static void push_held(const JointRows<T, kind>& rows, const V* change, Twist<V>& a,
                                    Twist<V>& b) {
    for (const PointRows<V>& row : rows.points) {
      push(rows, row, Vec3L<V>{change[0], change[1], change[2]}, a, b);
      change += 3;
    }
    for (const auto& row : rows.lines) push(rows, row, *change++, a, b);
    for (const auto& row : rows.axes) push(rows, row, *change++, a, b);
  }

  /// rhs - J v - cfm p of all rows. Rows of limits and motors: without rhs and p.
  template <model::JointKind kind>
  PBMPI_LANES void set_errors(JointRows<T, kind>& rows, const Twist<V>& a, const Twist<V>& b,
                              V* errors) const {
    int index = 0;
    for (const PointRows<V>& point : rows.points) {
      const Vec3L<V> speed =
          a.linear + cross(a.angular, point.arm_a) - b.linear - cross(b.angular, point.arm_b);
      errors[index++] = -speed.x;
      errors[index++] = -speed.y;
      errors[index++] = -speed.z;
    }
    for (const auto& row : rows.lines) errors[index++] = -speed(row, a, b);
    for (const auto& row : rows.axes) errors[index++] = -speed(row, a, b);
    for_each_held_row(
        rows, laws_, cfm_,
        [&](int i, const V& rhs, const V& ahead, const V& cfm, const V& impulse, const RowLaw<Scalar>& law) {
          errors[i] += (rhs + ahead) * T::broadcast(law.bias) - cfm * impulse;
        });
    if (!rows.acts()) return;
    for_each_control(rows,
                     [&](const auto& control, std::size_t) { errors[index++] = -speed(control.row, a, b); });
  }

  /// Solves limits, motors and rotors, given that the held rows adapt. `change`: of these rows, from minus
  /// their speeds to changes of impulse. Two axes of a joint are solved in turn.
  template <model::JointKind kind>
  PBMPI_LANES void solve_controls(JointRows<T, kind>& rows, const V& where, V* change) const {
    constexpr int first = JointRows<T, kind>::counts.held(), count = JointRows<T, kind>::counts.all() - first;
    constexpr int num_turns = count > 1 ? 4 : 1;
    V error[2], total[2], control_change[2], rotor_change[2];
    for (int i = 0; i < count; ++i) {
      error[i] = change[first + i];
      total[i] = control_change[i] = rotor_change[i] = T::broadcast(0);
    }
    for (int turn = 0; turn < num_turns; ++turn) {
      for_each_control(rows, [&](const auto& control, std::size_t i) {
        V left = error[i];
        if (count > 1) left -= rows.block.lower[first + count - 1][first] * total[1 - i];
        const V& own = rows.block.lower[first + static_cast<int>(i)][first + static_cast<int>(i)];
        act(control, rows.control_on[i], rows.has_rotors, own, left, control_change[i], rotor_change[i]);
        total[i] = control_change[i] + rotor_change[i];
      });
    }
    const auto is_wanted = where > T::broadcast(0);
    for_each_control(rows, [&](auto& control, std::size_t i) {
      control.row.impulse = is_wanted ? control.row.impulse + control_change[i] : control.row.impulse;
      control.rotor.impulse = is_wanted ? control.rotor.impulse + rotor_change[i] : control.rotor.impulse;
      change[first + static_cast<int>(i)] = total[i] * where;
    });
  }
  /// The changes of impulse of one axis. `own`: the speed that an impulse makes; `error`: minus the speed
  /// before. With a rotor of inertia I the coordinate resists as if its effective mass were greater by I.
  template <class Row>
  PBMPI_LANES void act(const Bounded<Row, V>& control, bool is_on, bool has_rotor, const V& own,
                       const V& error, V& control_change, V& rotor_change) const {
    const Rotor<V>& rotor = control.rotor;
    const V zero = T::broadcast(0), one = T::broadcast(1);
    const V share = has_rotor ? one / (one + rotor.inertia * own) : one;
    control_change = zero;
    if (is_on) {
      V speed = -error;
      if (has_rotor) speed = (own * (rotor.inertia * rotor.start - rotor.impulse) - error) * share;
      const V& impulse = control.row.impulse;
      const V cfm = cfm_of(control.row);
      const V rigid = (rhs_of(control) - speed - cfm * impulse) / (own * share + cfm) * T::broadcast(factor_);
      control_change = clamped(control, softened(control, rigid)) - impulse;
    }
    if (has_rotor)
      rotor_change = (rotor.inertia * (rotor.start + error - own * control_change) - rotor.impulse) * share;
  }
  /// The impulse of a limit or motor after the change that would hold it rigidly, before bounds. A limit
  /// gives under the load that it carries, except the push of its own motor: together the two do nothing to
  /// the bodies.
  template <class Row>
  PBMPI_LANES V softened(const Bounded<Row, V>& control, const V& rigid) const {
    const V mass_share = 1 - control.at_limit * T::broadcast(1 - laws_.turns.mass_share);
    const V relief = control.at_limit * T::broadcast(laws_.turns.relief);
    return control.row.impulse + (rigid * mass_share - relief * (control.row.impulse - control.push));
  }
  template <class Row>
  PBMPI_LANES static V clamped(const Bounded<Row, V>& control, const V& impulse) {
    return T::min(T::max(impulse, control.low), control.high);
  }

  Scalar cfm_, factor_;
  Laws laws_;
};

}  // namespace pbmpi::solver
