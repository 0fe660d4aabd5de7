/// Joints in lanes: the same joint of up to `num_lanes` articulations, its terms and its rows.
///
/// Which rows each kind has, with signs and right-hand sides as in ODE 0.16's joints (ode/src/joints/*.cpp):
///   ball       3 point                      hinge   3 point + 2 axis + limit/motor
///   universal  3 point + 1 axis + 2 l/m     fixed   3 point + 3 axis
///   hinge2     3 line (along axis 1 with the suspension's ERP and CFM, and across) + 1 axis + 2 l/m
///   slider     3 axis + 2 line + limit/motor along the line
#pragma once

#include <vector>

#include "solver/articulation.h"
#include "solver/body_lanes.h"

namespace pbmpi::solver {

/// Limit and motor of one axis: they may differ from lane to lane and change by events.
template <class V>
struct alignas(sizeof(V)) AxisControl {
  V low, high;                             ///< [rad] or [m]; +-huge = none
  V sin_low, cos_low, sin_high, cos_high;  ///< of half the angles
  V velocity, max_force;
  bool has_motor = false, has_limit = false;  ///< in any lane
};

template <class V>
struct alignas(sizeof(V)) JointTermsLane {
  Vec3L<V> anchor_a, anchor_b, axis1_a, axis1_b, axis2_b, normal1_a, normal2_b;
  V relative_w, relative_x, relative_y, relative_z;
  V cos0, sin0, stiffness, damping;
};

/// A line row of a joint, with bounds on its impulse.
template <class V>
struct alignas(sizeof(V)) BoundedLine {
  LineRow<V> line;
  V low, high;
};

/// One joint of a batch. `points`, `axes`, `lines` say which rows of the batch's arrays are its own; limits
/// and motors come last of its axes (of its lines for a slider).
template <class V>
struct alignas(sizeof(V)) JointLane {
  JointLink link;
  int slot_a = 0, slot_b = 0;
  int point = -1;  ///< index into the points, or none
  int first_axis = 0, num_axes = 0;
  int first_line = 0, num_lines = 0;
  JointTermsLane<V> terms;
  AxisControl<V> controls[2];
  bool control_rows[2] = {false, false};  ///< does a row stand for this axis now?
};

inline int fixed_axes(model::JointKind kind) {
  switch (kind) {
    case model::JointKind::hinge:
      return 2;
    case model::JointKind::universal:
    case model::JointKind::hinge2:
      return 1;
    case model::JointKind::fixed:
    case model::JointKind::slider:
      return 3;
    case model::JointKind::ball:
      return 0;
  }
  return 0;
}

inline int num_controls(model::JointKind kind) {
  switch (kind) {
    case model::JointKind::hinge:
    case model::JointKind::slider:
      return 1;
    case model::JointKind::universal:
    case model::JointKind::hinge2:
      return 2;
    default:
      return 0;
  }
}

/// Stands for infinity in bounds: far above any impulse [N s], and finite in float.
inline constexpr double huge_bound = 1e30;

/// Builds and solves the rows of one joint. Uniform numbers of the substep first.
template <class T>
class JointSolver {
 public:
  using V = typename T::V;
  using Scalar = typename T::Scalar;
  using L3 = Vec3L<V>;

  JointSolver(Scalar h, Scalar erp, Scalar cfm, Scalar sor_factor)
      : h_(h), k_(erp / h), cfm_(cfm / h), factor_(sor_factor) {}

  /// Rows from the poses; impulses start at 0. May add to the twists: a motor that is at its limit pushes as
  /// an external torque (ODE: dxJointLimitMotor::addLimot).
  void build(JointLane<V>& joint, BodyLanes<T>& bodies, std::vector<PointRows<V>>& points,
             std::vector<AxisRow<V>>& axes, std::vector<BoundedLine<V>>& lines) const;

  void solve(const JointLane<V>& joint, BodyLanes<T>& bodies, std::vector<PointRows<V>>& points,
             std::vector<AxisRow<V>>& axes, std::vector<BoundedLine<V>>& lines) const;

 private:
  void build_point(const JointLane<V>& joint, const BodyLane<V>& a, const BodyLane<V>& b,
                   PointRows<V>& row) const;
  void build_axis(const L3& axis, const V& rhs, const BodyLane<V>& a, const BodyLane<V>& b,
                  AxisRow<V>& row) const;
  void build_line(const L3& direction, const L3& moment_a, const L3& moment_b, const V& rhs, const V& cfm,
                  const BodyLane<V>& a, const BodyLane<V>& b, BoundedLine<V>& row) const;
  void build_suspended_point(const JointLane<V>& joint, const BodyLane<V>& a, const BodyLane<V>& b,
                             BoundedLine<V>* rows) const;
  void build_slider_lines(const JointLane<V>& joint, const BodyLane<V>& a, const BodyLane<V>& b,
                          BoundedLine<V>* rows) const;
  void build_orientation(const JointLane<V>& joint, const BodyLane<V>& a, const BodyLane<V>& b,
                         AxisRow<V>* rows) const;
  /// What an axis does now: at a limit (with its error), driven, or nothing.
  struct ControlState {
    bool any = false;
    V rhs, low, high;  ///< of the row
    V push;            ///< impulse of a motor that is at its limit; acts on a against the axis
  };
  /// at_low, at_high: 1 where the coordinate is at or past the limit, else 0; error: its distance from it.
  ControlState decide(const AxisControl<V>& control, const V& at_low, const V& at_high, const V& error) const;
  void build_slider_control(JointLane<V>& joint, const BodyLane<V>& a, const BodyLane<V>& b,
                            Twist<V>& twist_a, Twist<V>& twist_b, BoundedLine<V>& row) const;
  /// A limit or motor on `axis` whose coordinate is 2 atan2(s, c), c >= 0.
  void build_control(AxisControl<V>& control, bool& has_row, const L3& axis, const V& s, const V& c,
                     const BodyLane<V>& a, const BodyLane<V>& b, Twist<V>& twist_a, Twist<V>& twist_b,
                     AxisRow<V>& row) const;

  struct RelativeRotation {
    V w;
    L3 vector;  ///< a's frame
  };
  /// (q_a^-1 q_b) relative^-1: how b has turned against a since the start.
  RelativeRotation relative_rotation(const JointTermsLane<V>& terms, const BodyLane<V>& a,
                                     const BodyLane<V>& b) const;
  void hinge_angle(const JointLane<V>& joint, const BodyLane<V>& a, const BodyLane<V>& b, V& s, V& c) const;
  void build_crossed_axes(JointLane<V>& joint, const BodyLane<V>& a, const BodyLane<V>& b, Twist<V>& twist_a,
                          Twist<V>& twist_b, AxisRow<V>* rows, BoundedLine<V>* line_rows) const;

  static void solve_point(PointRows<V>& row, const V& inv_mass_a, const V& inv_mass_b, Scalar cfm,
                          Twist<V>& a, Twist<V>& b);
  static void solve_axis(AxisRow<V>& row, Twist<V>& a, Twist<V>& b);
  static void solve_line(BoundedLine<V>& row, const V& inv_mass_a, const V& inv_mass_b, Twist<V>& a,
                         Twist<V>& b);

  Scalar h_, k_, cfm_, factor_;
};

/// Two unit vectors across the unit vector n and each other (ODE's dPlaneSpace).
template <class T>
void plane_space(const Vec3L<typename T::V>& n, Vec3L<typename T::V>& p, Vec3L<typename T::V>& q) {
  using V = typename T::V;
  const auto steep = T::abs(n.z) > T::broadcast(static_cast<typename T::Scalar>(0.7071067811865475244));
  const V zero = T::broadcast(0);
  const V a = steep ? n.y * n.y + n.z * n.z : n.x * n.x + n.y * n.y;
  const V k = 1 / T::sqrt(a);
  p.x = steep ? zero : -n.y * k;
  p.y = steep ? -n.z * k : n.x * k;
  p.z = steep ? n.y * k : zero;
  q.x = steep ? a * k : -n.z * p.y;
  q.y = steep ? -n.x * p.z : n.z * p.x;
  q.z = steep ? n.x * p.y : a * k;
}

template <class T>
void JointSolver<T>::build_point(const JointLane<V>& joint, const BodyLane<V>& a, const BodyLane<V>& b,
                                 PointRows<V>& row) const {
  row.arm_a = a.rotation * joint.terms.anchor_a;
  row.arm_b = b.rotation * joint.terms.anchor_b;
  const V zero = T::broadcast(0);
  const L3 moment_a[3] = {{zero, row.arm_a.z, -row.arm_a.y},
                          {-row.arm_a.z, zero, row.arm_a.x},
                          {row.arm_a.y, -row.arm_a.x, zero}};
  const L3 moment_b[3] = {{zero, row.arm_b.z, -row.arm_b.y},
                          {-row.arm_b.z, zero, row.arm_b.x},
                          {row.arm_b.y, -row.arm_b.x, zero}};
  V diagonal[3];
  for (int k = 0; k < 3; ++k) {
    row.turn_a[k] = a.inv_inertia * moment_a[k];
    row.turn_b[k] = b.inv_inertia * moment_b[k];
    diagonal[k] = a.inv_mass + b.inv_mass + dot(moment_a[k], row.turn_a[k]) + dot(moment_b[k], row.turn_b[k]);
  }
  row.rhs = (b.position + row.arm_b - a.position - row.arm_a) * T::broadcast(k_);
  row.scale = {factor_ / (diagonal[0] + cfm_), factor_ / (diagonal[1] + cfm_),
               factor_ / (diagonal[2] + cfm_)};
  row.impulse = {zero, zero, zero};
}

template <class T>
void JointSolver<T>::build_axis(const L3& axis, const V& rhs, const BodyLane<V>& a, const BodyLane<V>& b,
                                AxisRow<V>& row) const {
  row.axis = axis;
  row.turn_a = a.inv_inertia * axis;
  row.turn_b = b.inv_inertia * axis;
  row.rhs = rhs;
  row.cfm = T::broadcast(cfm_);
  row.scale = factor_ / (dot(axis, row.turn_a) + dot(axis, row.turn_b) + cfm_);
  row.low = T::broadcast(static_cast<Scalar>(-huge_bound));
  row.high = T::broadcast(static_cast<Scalar>(huge_bound));
  row.impulse = T::broadcast(0);
}

template <class T>
void JointSolver<T>::build_line(const L3& direction, const L3& moment_a, const L3& moment_b, const V& rhs,
                                const V& cfm, const BodyLane<V>& a, const BodyLane<V>& b,
                                BoundedLine<V>& bounded) const {
  LineRow<V>& row = bounded.line;
  bounded.low = T::broadcast(static_cast<Scalar>(-huge_bound));
  bounded.high = T::broadcast(static_cast<Scalar>(huge_bound));
  row.direction = direction;
  row.moment_a = moment_a;
  row.moment_b = moment_b;
  row.turn_a = a.inv_inertia * moment_a;
  row.turn_b = b.inv_inertia * moment_b;
  row.rhs = rhs;
  row.cfm = cfm;
  row.scale =
      factor_ / (a.inv_mass + b.inv_mass + dot(moment_a, row.turn_a) + dot(moment_b, row.turn_b) + cfm);
  row.impulse = T::broadcast(0);
}

/// hinge2: the point held along axis 1 (softly, if sprung) and across it.
template <class T>
void JointSolver<T>::build_suspended_point(const JointLane<V>& joint, const BodyLane<V>& a,
                                           const BodyLane<V>& b, BoundedLine<V>* rows) const {
  const JointTermsLane<V>& terms = joint.terms;
  const L3 arm_a = a.rotation * terms.anchor_a, arm_b = b.rotation * terms.anchor_b;
  const L3 error = b.position + arm_b - a.position - arm_a;
  L3 directions[3];
  directions[0] = a.rotation * terms.axis1_a;
  plane_space<T>(directions[0], directions[1], directions[2]);
  for (int i = 0; i < 3; ++i) {
    V k = T::broadcast(k_), cfm = T::broadcast(cfm_);
    if (i == 0 && joint.link.sprung) {
      const V total = h_ * terms.stiffness + terms.damping;  // ERP = h k / total, CFM = 1 / total
      k = terms.stiffness / total;
      cfm = 1 / (total * h_);
    }
    build_line(directions[i], cross(arm_a, directions[i]), -cross(arm_b, directions[i]),
               k * dot(directions[i], error), cfm, a, b, rows[i]);
  }
}

template <class T>
void JointSolver<T>::build_slider_lines(const JointLane<V>& joint, const BodyLane<V>& a, const BodyLane<V>& b,
                                        BoundedLine<V>* rows) const {
  const L3 axis = a.rotation * joint.terms.axis1_a;
  const L3 apart = b.position - a.position;
  const L3 error = apart + b.rotation * joint.terms.anchor_b;
  L3 directions[2];
  plane_space<T>(axis, directions[0], directions[1]);
  const V half = T::broadcast(static_cast<Scalar>(0.5));
  for (int i = 0; i < 2; ++i) {
    const L3 moment = cross(apart, directions[i]) * half;
    build_line(directions[i], moment, moment, k_ * dot(directions[i], error), T::broadcast(cfm_), a, b,
               rows[i]);
  }
}

/// hinge: the two axes 1 stay parallel; fixed, slider: the whole relative orientation stays.
template <class T>
void JointSolver<T>::build_orientation(const JointLane<V>& joint, const BodyLane<V>& a, const BodyLane<V>& b,
                                       AxisRow<V>* rows) const {
  const JointTermsLane<V>& terms = joint.terms;
  if (joint.link.kind == model::JointKind::hinge) {
    const L3 axis_a = a.rotation * terms.axis1_a;
    const L3 error = cross(axis_a, b.rotation * terms.axis1_b);
    L3 p, q;
    plane_space<T>(axis_a, p, q);
    build_axis(p, k_ * dot(error, p), a, b, rows[0]);
    build_axis(q, k_ * dot(error, q), a, b, rows[1]);
    return;
  }
  // qerr = (q_a^-1 q_b) relative^-1; its vector part is half the error, in a's frame (ODE:
  // setFixedOrientation).
  const RelativeRotation turn = relative_rotation(terms, a, b);
  const V zero = T::broadcast(0);
  const V sign = turn.w < zero ? T::broadcast(-1) : T::broadcast(1);
  const L3 error = a.rotation * (turn.vector * sign);
  const V one = T::broadcast(1);
  const V twice = T::broadcast(2 * k_);
  build_axis({one, zero, zero}, twice * error.x, a, b, rows[0]);
  build_axis({zero, one, zero}, twice * error.y, a, b, rows[1]);
  build_axis({zero, zero, one}, twice * error.z, a, b, rows[2]);
}

template <class T>
typename JointSolver<T>::ControlState JointSolver<T>::decide(const AxisControl<V>& control,
                                                             const V& at_low_flag, const V& at_high_flag,
                                                             const V& error) const {
  const V zero = T::broadcast(0);
  const V bound = T::broadcast(static_cast<Scalar>(huge_bound));
  const auto at_low = at_low_flag != zero;
  const auto at_high = at_high_flag != zero;
  const auto locked = control.low == control.high;
  const V force = control.max_force * h_;
  ControlState state;
  state.rhs = at_low ? -k_ * error : (at_high ? -k_ * error : control.velocity);
  state.low = at_low ? (locked ? -bound : zero) : (at_high ? -bound : -force);
  state.high = at_low ? bound : (at_high ? (locked ? bound : zero) : force);
  // A motor at its limit is a constant torque, into the limit unless the motor turns away from it.
  const V at_rest = at_low ? force : -force;
  const V push = control.velocity > zero ? -force : (control.velocity < zero ? force : at_rest);
  state.push = at_low ? push : (at_high ? push : zero);
  state.push = locked ? zero : state.push;
  return state;
}

template <class T>
void JointSolver<T>::build_control(AxisControl<V>& control, bool& has_row, const L3& axis, const V& s,
                                   const V& c, const BodyLane<V>& a, const BodyLane<V>& b, Twist<V>& twist_a,
                                   Twist<V>& twist_b, AxisRow<V>& row) const {
  V at_low = T::broadcast(0), at_high = at_low, error = at_low;
  has_row = control.has_motor;
  if (control.has_limit) {
    for (int lane = 0; lane < T::num_lanes; ++lane) {
      const Scalar sine = T::get(s, lane), cosine = T::get(c, lane);
      const bool low = sine * T::get(control.cos_low, lane) <= cosine * T::get(control.sin_low, lane);
      const bool high = sine * T::get(control.cos_high, lane) >= cosine * T::get(control.sin_high, lane);
      if (!low && !high) continue;
      has_row = true;
      T::set(low ? at_low : at_high, lane, Scalar{1});
      T::set(error, lane, 2 * std::atan2(sine, cosine) - T::get(low ? control.low : control.high, lane));
    }
  }
  if (!has_row) return;
  const ControlState state = decide(control, at_low, at_high, error);
  build_axis(axis, state.rhs, a, b, row);
  row.low = state.low;
  row.high = state.high;
  twist_a.angular = twist_a.angular - row.turn_a * state.push;
  twist_b.angular = twist_b.angular + row.turn_b * state.push;
}

template <class T>
void JointSolver<T>::build_slider_control(JointLane<V>& joint, const BodyLane<V>& a, const BodyLane<V>& b,
                                          Twist<V>& twist_a, Twist<V>& twist_b, BoundedLine<V>& row) const {
  const AxisControl<V>& control = joint.controls[0];
  const L3 axis = a.rotation * joint.terms.axis1_a;
  const L3 apart = b.position - a.position;
  const V place = -dot(axis, apart + b.rotation * joint.terms.anchor_b);
  V at_low = T::broadcast(0), at_high = at_low, error = at_low;
  joint.control_rows[0] = control.has_motor;
  for (int lane = 0; lane < T::num_lanes && control.has_limit; ++lane) {
    const Scalar x = T::get(place, lane);
    const bool low = x <= T::get(control.low, lane);
    const bool high = x >= T::get(control.high, lane);
    if (!low && !high) continue;
    joint.control_rows[0] = true;
    T::set(low ? at_low : at_high, lane, Scalar{1});
    T::set(error, lane, x - T::get(low ? control.low : control.high, lane));
  }
  if (!joint.control_rows[0]) return;
  const ControlState state = decide(control, at_low, at_high, error);
  const L3 moment = cross(apart * T::broadcast(static_cast<Scalar>(0.5)), axis);
  build_line(axis, moment, moment, state.rhs, T::broadcast(cfm_), a, b, row);
  row.low = state.low;
  row.high = state.high;
  twist_a.linear = twist_a.linear - axis * (a.inv_mass * state.push);
  twist_a.angular = twist_a.angular - row.line.turn_a * state.push;
  twist_b.linear = twist_b.linear + axis * (b.inv_mass * state.push);
  twist_b.angular = twist_b.angular - row.line.turn_b * state.push;
}

template <class T>
void JointSolver<T>::build(JointLane<V>& joint, BodyLanes<T>& bodies, std::vector<PointRows<V>>& points,
                           std::vector<AxisRow<V>>& axes, std::vector<BoundedLine<V>>& lines) const {
  using model::JointKind;
  const BodyLane<V>& a = bodies.bodies[joint.slot_a];
  const BodyLane<V>& b = bodies.bodies[joint.slot_b];
  Twist<V>& twist_a = bodies.twists[joint.slot_a];
  Twist<V>& twist_b = bodies.twists[joint.slot_b];
  const JointTermsLane<V>& terms = joint.terms;
  AxisRow<V>* rows = axes.data() + joint.first_axis;
  BoundedLine<V>* line_rows = lines.data() + joint.first_line;
  if (joint.point >= 0) build_point(joint, a, b, points[joint.point]);
  switch (joint.link.kind) {
    case JointKind::ball:
      break;
    case JointKind::fixed:
      build_orientation(joint, a, b, rows);
      break;
    case JointKind::slider:
      build_orientation(joint, a, b, rows);
      build_slider_lines(joint, a, b, line_rows);
      build_slider_control(joint, a, b, twist_a, twist_b, line_rows[2]);
      break;
    case JointKind::hinge:
      build_orientation(joint, a, b, rows);
      if (joint.controls[0].has_motor || joint.controls[0].has_limit) {
        V s, c;
        hinge_angle(joint, a, b, s, c);
        build_control(joint.controls[0], joint.control_rows[0], a.rotation * terms.axis1_a, s, c, a, b,
                      twist_a, twist_b, rows[2]);
      }
      break;
    case JointKind::universal:
    case JointKind::hinge2:
      build_crossed_axes(joint, a, b, twist_a, twist_b, rows, line_rows);
      break;
  }
}

/// The angle as ODE's getHingeAngle has it: from the quaternion of b relative to a relative to the start.
template <class T>
void JointSolver<T>::hinge_angle(const JointLane<V>& joint, const BodyLane<V>& a, const BodyLane<V>& b, V& s,
                                 V& c) const {
  const JointTermsLane<V>& terms = joint.terms;
  const RelativeRotation turn = relative_rotation(terms, a, b);
  const V zero = T::broadcast(0);
  const V length = T::sqrt(dot(turn.vector, turn.vector));
  const V along = dot(turn.vector, terms.axis1_a);
  s = along >= zero ? -length : length;  // the angle of a relative to b
  s = turn.w < zero ? -s : s;
  c = T::abs(turn.w);
}

template <class T>
typename JointSolver<T>::RelativeRotation JointSolver<T>::relative_rotation(const JointTermsLane<V>& terms,
                                                                            const BodyLane<V>& a,
                                                                            const BodyLane<V>& b) const {
  const V rw = a.qw * b.qw + a.qx * b.qx + a.qy * b.qy + a.qz * b.qz;
  const V rx = a.qw * b.qx - a.qx * b.qw - a.qy * b.qz + a.qz * b.qy;
  const V ry = a.qw * b.qy - a.qy * b.qw - a.qz * b.qx + a.qx * b.qz;
  const V rz = a.qw * b.qz - a.qz * b.qw - a.qx * b.qy + a.qy * b.qx;
  const V &sw = terms.relative_w, &sx = terms.relative_x, &sy = terms.relative_y, &sz = terms.relative_z;
  return {rw * sw + rx * sx + ry * sy + rz * sz,
          {rx * sw - rw * sx - ry * sz + rz * sy, ry * sw - rw * sy - rz * sx + rx * sz,
           rz * sw - rw * sz - rx * sy + ry * sx}};
}

/// universal, hinge2: an axis fixed in each body.
template <class T>
void JointSolver<T>::build_crossed_axes(JointLane<V>& joint, const BodyLane<V>& a, const BodyLane<V>& b,
                                        Twist<V>& twist_a, Twist<V>& twist_b, AxisRow<V>* rows,
                                        BoundedLine<V>* line_rows) const {
  const JointTermsLane<V>& terms = joint.terms;
  const bool universal = joint.link.kind == model::JointKind::universal;
  if (!universal) build_suspended_point(joint, a, b, line_rows);
  const L3 axis1 = a.rotation * terms.axis1_a, axis2 = b.rotation * terms.axis2_b;
  const L3 crossed = cross(axis1, axis2);
  const V sine = T::sqrt(dot(crossed, crossed));
  const V cosine = dot(axis1, axis2);
  // universal: the axes stay at right angles; hinge2: at the angle of the start. cos0 is 0 for ODE's
  // universal.
  const V rhs = universal ? -k_ * cosine : k_ * (terms.cos0 * sine - terms.sin0 * cosine);
  build_axis(crossed * (1 / sine), rhs, a, b, rows[0]);
  for (int i = 0; i < 2; ++i) {
    AxisControl<V>& control = joint.controls[i];
    joint.control_rows[i] = false;
    if (!control.has_motor && !control.has_limit) continue;
    // Angle 1: where a sees axis 2 turned about its axis 1. Angle 2: where b sees axis 1 turned about its
    // axis 2.
    const L3& axis = i == 0 ? axis1 : axis2;
    const L3 normal = i == 0 ? a.rotation * terms.normal1_a : b.rotation * terms.normal2_b;
    const L3& seen = i == 0 ? axis2 : axis1;
    const V x = dot(seen, normal);
    const V y = dot(seen, cross(axis, normal));
    const V c = T::sqrt(x * x + y * y) + x;
    build_control(control, joint.control_rows[i], axis, i == 0 ? -y : y, c, a, b, twist_a, twist_b,
                  rows[1 + i]);
  }
}

template <class T>
void JointSolver<T>::solve_point(PointRows<V>& row, const V& inv_mass_a, const V& inv_mass_b, Scalar cfm,
                                 Twist<V>& a, Twist<V>& b) {
  const L3 &ra = row.arm_a, &rb = row.arm_b;
  {
    const V speed = a.linear.x + a.angular.y * ra.z - a.angular.z * ra.y - b.linear.x - b.angular.y * rb.z +
                    b.angular.z * rb.y;
    const V change = (row.rhs.x - speed - cfm * row.impulse.x) * row.scale.x;
    row.impulse.x += change;
    a.linear.x += inv_mass_a * change;
    b.linear.x -= inv_mass_b * change;
    a.angular = a.angular + row.turn_a[0] * change;
    b.angular = b.angular - row.turn_b[0] * change;
  }
  {
    const V speed = a.linear.y + a.angular.z * ra.x - a.angular.x * ra.z - b.linear.y - b.angular.z * rb.x +
                    b.angular.x * rb.z;
    const V change = (row.rhs.y - speed - cfm * row.impulse.y) * row.scale.y;
    row.impulse.y += change;
    a.linear.y += inv_mass_a * change;
    b.linear.y -= inv_mass_b * change;
    a.angular = a.angular + row.turn_a[1] * change;
    b.angular = b.angular - row.turn_b[1] * change;
  }
  {
    const V speed = a.linear.z + a.angular.x * ra.y - a.angular.y * ra.x - b.linear.z - b.angular.x * rb.y +
                    b.angular.y * rb.x;
    const V change = (row.rhs.z - speed - cfm * row.impulse.z) * row.scale.z;
    row.impulse.z += change;
    a.linear.z += inv_mass_a * change;
    b.linear.z -= inv_mass_b * change;
    a.angular = a.angular + row.turn_a[2] * change;
    b.angular = b.angular - row.turn_b[2] * change;
  }
}

template <class T>
void JointSolver<T>::solve_axis(AxisRow<V>& row, Twist<V>& a, Twist<V>& b) {
  const V change = (row.rhs - dot(row.axis, a.angular - b.angular) - row.cfm * row.impulse) * row.scale;
  const V impulse = T::min(T::max(row.impulse + change, row.low), row.high);
  const V applied = impulse - row.impulse;
  row.impulse = impulse;
  a.angular = a.angular + row.turn_a * applied;
  b.angular = b.angular - row.turn_b * applied;
}

template <class T>
void JointSolver<T>::solve_line(BoundedLine<V>& row, const V& inv_mass_a, const V& inv_mass_b, Twist<V>& a,
                                Twist<V>& b) {
  LineRow<V>& line = row.line;
  const V change = (line.rhs - relative_speed(line, a, b) - line.cfm * line.impulse) * line.scale;
  const V impulse = T::min(T::max(line.impulse + change, row.low), row.high);
  const V applied = impulse - line.impulse;
  line.impulse = impulse;
  apply(line, applied, inv_mass_a, a);
  apply_to_b(line, applied, inv_mass_b, b);
}

template <class T>
void JointSolver<T>::solve(const JointLane<V>& joint, BodyLanes<T>& bodies, std::vector<PointRows<V>>& points,
                           std::vector<AxisRow<V>>& axes, std::vector<BoundedLine<V>>& lines) const {
  Twist<V> a = bodies.twists[joint.slot_a], b = bodies.twists[joint.slot_b];
  const V inv_mass_a = bodies.bodies[joint.slot_a].inv_mass,
          inv_mass_b = bodies.bodies[joint.slot_b].inv_mass;
  if (joint.point >= 0) solve_point(points[joint.point], inv_mass_a, inv_mass_b, cfm_, a, b);
  const bool slider = joint.link.kind == model::JointKind::slider;
  const int controls_begin = slider ? joint.num_lines : joint.num_axes;
  for (int i = 0; i < joint.num_lines; ++i)
    solve_line(lines[joint.first_line + i], inv_mass_a, inv_mass_b, a, b);
  for (int i = 0; i < joint.num_axes; ++i) solve_axis(axes[joint.first_axis + i], a, b);
  for (int i = 0; i < 2; ++i) {
    if (!joint.control_rows[i]) continue;
    if (slider) {
      solve_line(lines[joint.first_line + controls_begin + i], inv_mass_a, inv_mass_b, a, b);
    } else {
      solve_axis(axes[joint.first_axis + controls_begin + i], a, b);
    }
  }
  bodies.twists[joint.slot_a] = a;
  bodies.twists[joint.slot_b] = b;
}

}  // namespace pbmpi::solver
