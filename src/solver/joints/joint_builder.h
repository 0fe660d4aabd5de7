/// Builds the rows of a joint from the poses of its bodies.
#pragma once

#include <limits>

#include "solver/joints/control_builder.h"
#include "solver/joints/joint_points.h"
#include "solver/joints/joint_solver.h"
#include "solver/lanes/plane_space.h"

namespace pbmpi::solver {

/// Holds what is uniform in a substep, and builds the rows with it.
///
/// The bodies move in a substep with the velocities that the rows leave at its start, turning under their own
/// inertia, and relaxing sweeps hold their velocities at its end. A place is to stay over the whole substep,
/// up to errors of third order in the bodies' rotation. Rows see to that in one of two ways, or in between
/// (JointRows::reversible).
///
/// In the first they stand as the bodies will have turned in the middle. The joint's impulse then acts at the
/// start alone, as the next substep recalls it, and takes energy of first order in the substep. Sweeps need
/// this, which find an impulse over many substeps.
///
/// In the second they stand as at the start, and leave a speed `ahead`: minus what it will have gained in the
/// middle. Either end of the substep then takes half of the impulse. This is the scheme of RATTLE (H. C.
/// Andersen, J. Comput. Phys. 52, 1983): it is reversible, and lets energy swing but not drift. It needs rows
/// that are solved exactly. Where the impulses turn a body by a large share of what it turns anyway, as in a
/// whip, the first way takes over: it bears and damps what the substep does not resolve. What the bodies gain
/// because they turn under their own inertia is ahead of exact rows in both ways: no impulse has a part in
/// it. (The lines of hinge2 have nothing ahead.)
template <class T>
class JointBuilder {
 public:
  using V = typename T::V;
  using Scalar = typename T::Scalar;
  using L3 = Vec3L<V>;

  /// `ahead_s` [s]: half of the substep, or 0 for rows that have nothing ahead. `fastest` [m/s] or [rad/s]:
  /// at which joints close their errors.
  JointBuilder(Scalar h, const JointErp<Scalar>& erp, Scalar cfm, Scalar ahead_s, Scalar fastest)
      : ahead_s_(ahead_s),
        fastest_(fastest),
        rules_(h, erp.turns, fastest),
        rows_(erp.places / h, erp.turns / h, cfm / h),
        controls_(rules_, rows_) {}

  /// Builds the rows from the poses, with nothing ahead. Their impulses stay as they are, though directions
  /// may have turned. `exact`: 1 in the lanes in which the rows are solved exactly, else 0. `carried`:
  /// the impulses with which they will start.
  template <model::JointKind kind>
  void build(JointLane<V>& joint, const V& exact, const JointForceLane<V>& carried,
             const BodyLanes<T>& bodies, JointRows<T, kind>& rows) const;
  /// Sets what rows have ahead in the lanes in which they are solved exactly, from the velocities with which
  /// the bodies are expected to move.
  template <model::JointKind kind>
  void look_ahead(const JointLane<V>& joint, const BodyLanes<T>& bodies, JointRows<T, kind>& rows) const;

 private:
  using Pair = JointBodies<V>;

  void set_suspended_point(const JointLane<V>& joint, const Pair& pair, const V& exact,
                           LineRow<V>* rows) const;
  void set_slider_lines(const JointTermsLane<V>& terms, const Pair& pair, const V& exact,
                        LineRow<V>* rows) const;
  void set_parallel_axes(const JointTermsLane<V>& terms, const Pair& pair, AxisRow<V>* rows) const;
  void set_orientation(const JointTermsLane<V>& terms, const Pair& pair, AxisRow<V>* rows) const;
  V ahead_of_line(const LineRow<V>& row, const Pair& pair, const BodyLanes<T>& bodies,
                  const JointLane<V>& joint) const;
  /// The square of the share of a body's angular velocity that the carried impulses change.
  V unrest(const BodyLanes<T>& bodies, int slot, const L3& anchor, const JointForceLane<V>& carried) const {
    const BodyLane<V>& body = bodies.bodies[slot];
    const L3 change = body.inv_inertia * (cross(body.rotation * anchor, carried.force) + carried.torque);
    const L3& turning = bodies.twists[slot].angular;
    const V square = dot(change, change);
    return square / (square + dot(turning, turning) + T::broadcast(std::numeric_limits<Scalar>::min()));
  }
  /// What an axis that turns with a body gains, times `speed`: that about it.
  L3 gain_of_axis(const L3& axis, const L3& angular, const V& speed) const {
    return (middle_of_turn<T>(axis, angular * T::broadcast(ahead_s_)) - axis) * speed;
  }
  template <model::JointKind kind>
  void set_crossed_axes(JointLane<V>& joint, const Pair& pair, JointRows<T, kind>& rows) const;

  Scalar ahead_s_, fastest_;
  ControlRules<T> rules_;
  RowBuilder<T> rows_;
  ControlBuilder<T> controls_;
};

template <class T>
template <model::JointKind kind>
void JointBuilder<T>::build(JointLane<V>& joint, const V& exact, const JointForceLane<V>& carried,
                            const BodyLanes<T>& bodies, JointRows<T, kind>& rows) const {
  constexpr const model::JointTraits& traits = model::traits_of(kind);
  const Pair pair{bodies.bodies[joint.slot_a], bodies.bodies[joint.slot_b]};
  rows.sprung = traits.has_suspension() && joint.sprung;
  rows.slot_a = joint.slot_a;
  rows.slot_b = joint.slot_b;
  rows.inv_mass_a = pair.a.inv_mass;
  rows.inv_mass_b = pair.b.inv_mass;
  rows.holds = joint.holds;
  rows.has_block = false;
  rows.has_rotors = joint.controls[0].has_rotor || joint.controls[1].has_rotor;
  rows.reversible = exact;
  if (T::any(exact)) {
    // Both ways have equal shares where an impulse changes a body's turning by 5 %.
    rows.reversible =
        exact / (1 + T::broadcast(400) * (unrest(bodies, joint.slot_a, joint.terms.anchor_a, carried) +
                                          unrest(bodies, joint.slot_b, joint.terms.anchor_b, carried)));
  }
  for (PointRows<V>& point : rows.points)
    build_point<T>(joint.terms, bodies, joint.slot_a, joint.slot_b, rows_.place_k(), ahead_s_,
                   rows.reversible, fastest_, point);
  if constexpr (traits.turn == model::HeldTurn::axis) set_parallel_axes(joint.terms, pair, rows.axes.data());
  if constexpr (traits.turn == model::HeldTurn::orientation)
    set_orientation(joint.terms, pair, rows.axes.data());
  if constexpr (traits.place == model::HeldPlace::suspended_anchor)
    set_suspended_point(joint, pair, rows.reversible, rows.lines.data());
  if constexpr (traits.place == model::HeldPlace::line)
    set_slider_lines(joint.terms, pair, rows.reversible, rows.lines.data());
  if constexpr (traits.num_axes == 2) set_crossed_axes(joint, pair, rows);
  if constexpr (traits.num_axes == 1 && traits.slides) controls_.set_slider_control(joint, pair, rows);
  if constexpr (traits.num_axes == 1 && !traits.slides) controls_.set_hinge_control(joint, pair, rows);
}

template <class T>
template <model::JointKind kind>
void JointBuilder<T>::look_ahead(const JointLane<V>& joint, const BodyLanes<T>& bodies,
                                 JointRows<T, kind>& rows) const {
  constexpr const model::JointTraits& traits = model::traits_of(kind);
  if (!(ahead_s_ > 0)) return;
  const BodyLane<V>&a = bodies.bodies[joint.slot_a], &b = bodies.bodies[joint.slot_b];
  const L3 &turn_a = bodies.expected[joint.slot_a].angular, &turn_b = bodies.expected[joint.slot_b].angular;
  const L3 &more_a = bodies.half_turnings[joint.slot_a], &more_b = bodies.half_turnings[joint.slot_b];
  const auto is_wanted = rows.reversible > T::broadcast(0);
  // `own`: what the bodies gain under their own inertia; `turned`: what turned arms and axes gain.
  const auto set = [&](V& ahead, const V& own, const V& turned) {
    ahead = is_wanted ? own + turned * rows.reversible : ahead;
  };
  for (PointRows<V>& point : rows.points) {
    const L3 own = cross(more_b, point.arm_b) - cross(more_a, point.arm_a);
    const L3 turned =
        gain_of_arm<T>(point.arm_b, turn_b, ahead_s_) - gain_of_arm<T>(point.arm_a, turn_a, ahead_s_);
    set(point.ahead.x, own.x, turned.x);
    set(point.ahead.y, own.y, turned.y);
    set(point.ahead.z, own.z, turned.z);
  }
  const V zero = T::broadcast(0);
  L3 turned{zero, zero, zero};
  if constexpr (traits.turn == model::HeldTurn::axis) {
    const L3 axis = a.rotation * joint.terms.axis1_a;
    turned = gain_of_axis(axis, turn_a, dot(axis, turn_a - turn_b));
  } else if constexpr (traits.num_axes == 2) {
    const L3 axis1 = a.rotation * joint.terms.axis1_a, axis2 = b.rotation * joint.terms.axis2_b;
    const V cosine = dot(axis1, axis2), per = 1 / (1 - cosine * cosine);
    const V along1 = dot(axis1, turn_a - turn_b), along2 = dot(axis2, turn_a - turn_b);
    turned = gain_of_axis(axis1, turn_a, (along1 - cosine * along2) * per) +
             gain_of_axis(axis2, turn_b, (along2 - cosine * along1) * per);
  }
  for (AxisRow<V>& row : rows.axes) set(row.ahead, dot(row.axis, more_b - more_a), dot(row.axis, turned));
  if constexpr (traits.place == model::HeldPlace::line) {
    const Pair pair{a, b};
    for (LineRow<V>& row : rows.lines)
      set(row.ahead, -dot(row.moment_a, more_a + more_b), ahead_of_line(row, pair, bodies, joint));
  }
}

/// slider: the lines turn with a, and their arms grow as the bodies slide. Without what the bodies gain under
/// their own inertia.
template <class T>
typename T::V JointBuilder<T>::ahead_of_line(const LineRow<V>& row, const Pair& pair,
                                             const BodyLanes<T>& bodies, const JointLane<V>& joint) const {
  const Twist<V>&a = bodies.expected[joint.slot_a], &b = bodies.expected[joint.slot_b];
  const L3 arm = slider_arm<T>(pair, pair.b.position - pair.a.position);
  const L3 apart = b.linear - a.linear, growth = slider_arm<T>(pair, apart);
  const L3 turn = cross(a.angular, row.direction);
  const V gain =
      dot(cross(growth, row.direction) + cross(arm, turn), a.angular + b.angular) - dot(turn, apart);
  return -(gain * T::broadcast(ahead_s_));
}

/// hinge2: holds the point along axis 1 (softly, if sprung) and across it.
template <class T>
void JointBuilder<T>::set_suspended_point(const JointLane<V>& joint, const Pair& pair, const V& exact,
                                          LineRow<V>* rows) const {
  const JointTermsLane<V>& terms = joint.terms;
  const L3 arm_a = pair.a.rotation * terms.anchor_a, arm_b = pair.b.rotation * terms.anchor_b;
  const L3 error = ends_apart<T>(pair.a, arm_a, pair.b, arm_b, exact);
  L3 directions[3];
  directions[0] = pair.a.rotation * terms.axis1_a;
  plane_space<T>(directions[0], directions[1], directions[2]);
  for (int i = 0; i < 3; ++i) {
    V k = T::broadcast(rows_.place_k()), cfm = T::broadcast(rows_.cfm());
    if (i == 0 && joint.sprung) {
      const V total = rules_.h() * terms.stiffness + terms.damping;  // ERP = h k / total, CFM = 1 / total
      k = terms.stiffness / total;
      cfm = 1 / (total * rules_.h());
    }
    rows_.set_line(directions[i], cross(arm_a, directions[i]), -cross(arm_b, directions[i]),
                   k * dot(directions[i], error), cfm, pair, rows[i]);
  }
}

template <class T>
void JointBuilder<T>::set_slider_lines(const JointTermsLane<V>& terms, const Pair& pair, const V& exact,
                                       LineRow<V>* rows) const {
  const L3 axis = pair.a.rotation * terms.axis1_a;
  const L3 apart = centres_apart<T>(pair.a, pair.b, exact);
  const L3 error = apart + pair.b.rotation * terms.anchor_b;
  L3 directions[2];
  plane_space<T>(axis, directions[0], directions[1]);
  const L3 arm = slider_arm<T>(pair, apart);
  for (int i = 0; i < 2; ++i) {
    const L3 moment = cross(arm, directions[i]);
    rows_.set_line(directions[i], moment, moment, rows_.place_k() * dot(directions[i], error),
                   T::broadcast(rows_.cfm()), pair, rows[i]);
  }
}

/// hinge: holds axis 1 of the two bodies parallel.
template <class T>
void JointBuilder<T>::set_parallel_axes(const JointTermsLane<V>& terms, const Pair& pair,
                                        AxisRow<V>* rows) const {
  const L3 axis_a = pair.a.rotation * terms.axis1_a;
  const L3 error = cross(axis_a, pair.b.rotation * terms.axis1_b);
  L3 p, q;
  plane_space<T>(axis_a, p, q);
  rows_.set_axis(p, rows_.turn_k() * dot(error, p), pair, rows[0]);
  rows_.set_axis(q, rows_.turn_k() * dot(error, q), pair, rows[1]);
}

/// fixed, slider: holds the whole relative orientation. The vector part of the relative rotation is half the
/// error, in a's frame (ODE: setFixedOrientation).
template <class T>
void JointBuilder<T>::set_orientation(const JointTermsLane<V>& terms, const Pair& pair,
                                      AxisRow<V>* rows) const {
  const RelativeRotation<V> turn = relative_rotation(terms, pair);
  const V zero = T::broadcast(0), one = T::broadcast(1);
  const V sign = turn.w < zero ? -one : one;
  const L3 error = pair.a.rotation * (turn.vector * sign);
  const V twice = T::broadcast(2 * rows_.turn_k());
  rows_.set_axis({one, zero, zero}, twice * error.x, pair, rows[0]);
  rows_.set_axis({zero, one, zero}, twice * error.y, pair, rows[1]);
  rows_.set_axis({zero, zero, one}, twice * error.z, pair, rows[2]);
}

/// universal, hinge2: holds the angle between two axes, of which one is fixed in each body.
template <class T>
template <model::JointKind kind>
void JointBuilder<T>::set_crossed_axes(JointLane<V>& joint, const Pair& pair,
                                       JointRows<T, kind>& rows) const {
  const JointTermsLane<V>& terms = joint.terms;
  const L3 axis1 = pair.a.rotation * terms.axis1_a, axis2 = pair.b.rotation * terms.axis2_b;
  const L3 crossed = cross(axis1, axis2);
  const V sine = T::sqrt(dot(crossed, crossed));
  const V cosine = dot(axis1, axis2);
  // universal: the axes stay at right angles; hinge2: at the initial angle. cos0 is 0 for ODE's universal.
  const V rhs = model::traits_of(kind).turn == model::HeldTurn::right_angle
                    ? -rows_.turn_k() * cosine
                    : rows_.turn_k() * (terms.cos0 * sine - terms.sin0 * cosine);
  rows_.set_axis(crossed * (1 / sine), rhs, pair, rows.axes[0]);
  for (int i = 0; i < 2; ++i) {
    AxisControl<V>& control = joint.controls[i];
    // Angle 1: where a sees axis 2 turned about its axis 1. Angle 2: where b sees axis 1 turned about its
    // axis 2.
    const L3& axis = i == 0 ? axis1 : axis2;
    const auto half_angle = [&]() -> HalfAngle<V> {
      const L3 normal = i == 0 ? pair.a.rotation * terms.normal1_a : pair.b.rotation * terms.normal2_b;
      const L3& seen = i == 0 ? axis2 : axis1;
      const V x = dot(seen, normal);
      const V y = dot(seen, cross(axis, normal));
      const V c = T::sqrt(x * x + y * y) + x;
      return {i == 0 ? -y : y, c};
    };
    rows.control_on[i] = controls_.set_axis_control(control, axis, half_angle, pair, rows.axis_controls[i]);
  }
}

}  // namespace pbmpi::solver
