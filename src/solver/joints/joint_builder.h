/// Builds the rows of a joint from the poses of its bodies.
#pragma once

#include "solver/joints/control_builder.h"
#include "solver/joints/joint_points.h"
#include "solver/lanes/plane_space.h"

namespace pbmpi::solver {

/// Holds what is uniform in a step's first substep, and builds the rows with it. JointAdvancer advances the
/// rows through the later substeps.
template <class T>
class JointBuilder {
 public:
  using V = typename T::V;
  using Scalar = typename T::Scalar;
  using L3 = Vec3L<V>;

  /// `ahead_s`: see build_point(). `goes_on`: substeps follow this one, so the values from which they start
  /// are built too.
  JointBuilder(Scalar h, const JointErp<Scalar>& erp, Scalar cfm, Scalar sor_factor, Scalar ahead_s,
               bool goes_on)
      : ahead_s_(ahead_s),
        rules_(h, erp.turns),
        rows_(erp.places / h, erp.turns / h, cfm / h, sor_factor),
        controls_(rules_, rows_, goes_on) {}

  /// Builds the rows from the poses, without impulses.
  template <model::JointKind kind>
  void build(JointLane<V>& joint, const BodyLanes<T>& bodies, JointRows<T, kind>& rows) const;

 private:
  using Pair = JointBodies<V>;

  void set_suspended_point(const JointLane<V>& joint, const Pair& pair, LineRow<V>* rows) const;
  void set_slider_lines(const JointTermsLane<V>& terms, const Pair& pair, LineRow<V>* rows) const;
  void set_parallel_axes(const JointTermsLane<V>& terms, const Pair& pair, AxisRow<V>* rows) const;
  void set_orientation(const JointTermsLane<V>& terms, const Pair& pair, AxisRow<V>* rows) const;
  template <model::JointKind kind>
  void set_crossed_axes(JointLane<V>& joint, const Pair& pair, JointRows<T, kind>& rows) const;

  Scalar ahead_s_;
  ControlRules<T> rules_;
  RowBuilder<T> rows_;
  ControlBuilder<T> controls_;
};

template <class T>
template <model::JointKind kind>
void JointBuilder<T>::build(JointLane<V>& joint, const BodyLanes<T>& bodies, JointRows<T, kind>& rows) const {
  using model::JointKind;
  const Pair pair{bodies.bodies[joint.slot_a], bodies.bodies[joint.slot_b]};
  rows.sprung = kind == JointKind::hinge2 && joint.sprung;
  rows.slot_a = joint.slot_a;
  rows.slot_b = joint.slot_b;
  rows.inv_mass_a = pair.a.inv_mass;
  rows.inv_mass_b = pair.b.inv_mass;
  for (PointRows<V>& point : rows.points) {
    build_point<T>(joint.terms, bodies, joint.slot_a, joint.slot_b, rows_.place_k(), ahead_s_, point,
                   [&](const V& diagonal, const V&) { return rows_.factor() / (diagonal + rows_.cfm()); });
    point.impulse = {T::broadcast(0), T::broadcast(0), T::broadcast(0)};
  }
  if constexpr (kind == JointKind::hinge) {
    set_parallel_axes(joint.terms, pair, rows.axes.data());
    controls_.set_hinge_control(joint, pair, rows);
  } else if constexpr (kind == JointKind::fixed) {
    set_orientation(joint.terms, pair, rows.axes.data());
  } else if constexpr (kind == JointKind::universal) {
    set_crossed_axes(joint, pair, rows);
  } else if constexpr (kind == JointKind::hinge2) {
    set_suspended_point(joint, pair, rows.lines.data());
    set_crossed_axes(joint, pair, rows);
  } else if constexpr (kind == JointKind::slider) {
    set_orientation(joint.terms, pair, rows.axes.data());
    set_slider_lines(joint.terms, pair, rows.lines.data());
    controls_.set_slider_control(joint, pair, rows);
  }
}

/// hinge2: holds the point along axis 1 (softly, if sprung) and across it.
template <class T>
void JointBuilder<T>::set_suspended_point(const JointLane<V>& joint, const Pair& pair,
                                          LineRow<V>* rows) const {
  const JointTermsLane<V>& terms = joint.terms;
  const L3 arm_a = pair.a.rotation * terms.anchor_a, arm_b = pair.b.rotation * terms.anchor_b;
  const L3 error = pair.b.position + arm_b - pair.a.position - arm_a;
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
void JointBuilder<T>::set_slider_lines(const JointTermsLane<V>& terms, const Pair& pair,
                                       LineRow<V>* rows) const {
  const L3 axis = pair.a.rotation * terms.axis1_a;
  const L3 apart = pair.b.position - pair.a.position;
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
  const V rhs = kind == model::JointKind::universal
                    ? -rows_.turn_k() * cosine
                    : rows_.turn_k() * (terms.cos0 * sine - terms.sin0 * cosine);
  rows_.set_axis(crossed * (1 / sine), rhs, pair, rows.axes[0]);
  for (int i = 0; i < 2; ++i) {
    AxisControl<V>& control = joint.controls[i];
    rows.control_on[i] = control.any();
    if (!control.any()) continue;
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
