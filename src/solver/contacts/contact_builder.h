/// Builds the rows of contacts from the poses of their bodies.
#pragma once

#include <cstddef>
#include <limits>

#include "solver/contacts/contact_solver.h"
#include "solver/contacts/manifold_order.h"
#include "solver/lanes/plane_space.h"

namespace pbmpi::solver {

template <class T, bool two_bodies, ContactKind kind>
class ContactBuilder {
 public:
  using V = typename T::V;
  using Scalar = typename T::Scalar;
  using L3 = Vec3L<V>;
  using Solver = ContactSolver<T, two_bodies, kind>;
  using Row = typename Solver::Row;
  using Point = typename Solver::Point;
  using Motion = typename Solver::Motion;
  using Slot = typename Solver::Slot;
  using Friction = typename Solver::Friction;
  static constexpr bool rubs = Solver::friction || Solver::patched;

  ContactBuilder(const BodyLanes<T>& bodies, const ContactParameters<Scalar>& parameters)
      : bodies_(&bodies), parameters_(parameters) {}

  /// Rows of manifolds[num_lanes], before forces act on the twists (bounce looks at the speed of approach).
  /// Impulses start with their share of what the manifolds remember. `points`: [slot.num_points].
  void build(const Manifold* manifolds, Slot& slot, Point* points) const;

  /// Leads the points on to the next substep, with the velocities that the last sweep left: depths follow the
  /// normal speeds, directions and arms stay. Depth beyond what the push has planned is taken back at once:
  /// it is no more than the last sweep's residual.
  void advance(const Slot& slot, Point* points) const;

 private:
  /// What the builder reads of a manifold's bodies.
  struct BodyPair {
    L3 centre_a, centre_b;
    Sym3L<V> inv_inertia_a, inv_inertia_b;
    Motion motion_a, motion_b;
  };
  /// The current point of each lane's manifold; harmless numbers in idle lanes. Members that rows of this
  /// kind do not need are not read.
  struct Given {
    L3 position, normal;
    V depth, mu, restitution, factor;
    V normal_force;
    L3 friction_force;
  };

  /// From the centres of the bodies to a point, or to where their own surfaces are there: friction between
  /// the surfaces would slow down a ball that rolls, the more the deeper it is. ODE has it at the point.
  struct Arms {
    L3 a, b;
  };

  BodyPair gather(const Manifold* manifolds, ContactSlot<T>& slot) const;
  Given read(const Manifold* manifolds, int point) const;
  PBMPI_LANES Arms arms_of(const BodyPair& pair, const Given& given) const;
  /// [m^2/s^2] The square of the speed along the surface; 0 in lanes without the point.
  PBMPI_LANES static V slip_square(const BodyPair& pair, const Given& given, const Arms& arms,
                                   const V& outgoing) {
    L3 speed = pair.motion_a.linear + cross(pair.motion_a.angular, arms.a);
    if constexpr (two_bodies) speed = speed - (pair.motion_b.linear + cross(pair.motion_b.angular, arms.b));
    const V zero = T::broadcast(0);
    return given.factor > zero ? dot(speed, speed) - outgoing * outgoing : zero;
  }
  void build_point(ContactSlot<T>& slot, const BodyPair& pair, const Given& given, Point& point) const;
  /// Where depths are kept: a point that carries force lets its bodies come no closer, even if it has opened
  /// a little.
  PBMPI_LANES void keep_depth(Point& point) const {
    const V zero = T::broadcast(0);
    if (parameters_.keeps_depths) point.rhs = point.normal.impulse > zero ? zero : point.rhs;
  }
  /// What a patch needs of a point.
  struct PatchPart {
    Arms arms;
    L3 friction_force;  ///< [N] remembered
    V normal_force;     ///< [N] remembered
    V is_there;         ///< 1, or 0 in lanes whose manifold has no such point
  };
  /// The arms of a patch's middle: the mean of its points', each weighted by the normal force that it
  /// remembers, or of all alike where none remembers any.
  static Arms middle_of(const PatchPart* parts, int num_points);
  /// `first`: given for points[0]; `parts` [slot.num_points].
  void build_patch(const BodyPair& pair, const Given& first, const PatchPart* parts, Slot& slot,
                   Point* points) const;
  /// Friction rows at these arms, with the normal and mu of `given`; they start with the force `carried` [N].
  void build_friction(const ContactSlot<T>& slot, const BodyPair& pair, const Given& given, const Arms& arms,
                      const L3& carried, Friction& friction) const;
  PBMPI_LANES static void build_row(const ContactSlot<T>& slot, const BodyPair& pair, const L3& direction,
                                    const Arms& arms, Scalar cfm, const V& factor, Row& row);
  PBMPI_LANES Motion gather_motion(const std::int32_t* index) const {
    const Twist<V> twist = bodies_->gather_twist(index);
    if constexpr (Solver::central) {
      return twist.linear;
    } else {
      return twist;
    }
  }

  PBMPI_LANES L3 gather_vector(std::size_t member, const std::int32_t* index) const {
    return {bodies_->gather_member(member, index), bodies_->gather_member(member + sizeof(V), index),
            bodies_->gather_member(member + 2 * sizeof(V), index)};
  }
  PBMPI_LANES Sym3L<V> gather_inertia(const std::int32_t* index) const {
    constexpr std::size_t member = offsetof(BodyLane<V>, inv_inertia);
    const L3 upper = gather_vector(member, index), lower = gather_vector(member + 3 * sizeof(V), index);
    return {upper.x, upper.y, upper.z, lower.x, lower.y, lower.z};
  }

  const BodyLanes<T>* bodies_;
  ContactParameters<Scalar> parameters_;
};

template <class T, bool two_bodies, ContactKind kind>
void ContactBuilder<T, two_bodies, kind>::build(const Manifold* manifolds, Slot& slot, Point* points) const {
  const BodyPair pair = gather(manifolds, slot);
  [[maybe_unused]] PatchPart parts[ManifoldOrder::most_points];
  for (int i = 0; i < slot.num_points; ++i) {
    const Given given = read(manifolds, i);
    build_point(slot, pair, given, points[i]);
    if constexpr (Solver::patched)
      parts[i] = {arms_of(pair, given), given.friction_force, given.normal_force,
                  given.factor > T::broadcast(0) ? T::broadcast(1) : T::broadcast(0)};
  }
  if constexpr (Solver::patched) build_patch(pair, read(manifolds, 0), parts, slot, points);
}

template <class T, bool two_bodies, ContactKind kind>
typename ContactBuilder<T, two_bodies, kind>::BodyPair ContactBuilder<T, two_bodies, kind>::gather(
    const Manifold* manifolds, ContactSlot<T>& slot) const {
  std::int32_t body_a[T::num_lanes], body_b[T::num_lanes], twist_a[T::num_lanes], twist_b[T::num_lanes];
  for (int lane = 0; lane < T::num_lanes; ++lane) {
    const LanePlace a = manifolds[lane].a, b = manifolds[lane].b;
    slot.row_a[lane] = TwistRows<T>::index(a.slot, a.lane);
    slot.row_b[lane] = TwistRows<T>::index(b.slot, b.lane);
    twist_a[lane] = BodyLanes<T>::twist_index(a.slot, a.lane);
    twist_b[lane] = BodyLanes<T>::twist_index(b.slot, b.lane);
    body_a[lane] = BodyLanes<T>::body_index(a.slot, a.lane);
    body_b[lane] = BodyLanes<T>::body_index(b.slot, b.lane);
  }
  constexpr std::size_t inv_mass = offsetof(BodyLane<V>, inv_mass);
  constexpr std::size_t centre = offsetof(BodyLane<V>, position);
  BodyPair pair{};
  slot.inv_mass_a = bodies_->gather_member(inv_mass, body_a);
  slot.inv_mass_b = two_bodies ? bodies_->gather_member(inv_mass, body_b) : T::broadcast(0);
  slot.impact = slot.slides = T::broadcast(0);
  if (parameters_.restitution || parameters_.relaxes) {
    pair.motion_a = gather_motion(twist_a);
    if constexpr (two_bodies) pair.motion_b = gather_motion(twist_b);
  }
  if constexpr (!Solver::central) {
    pair.centre_a = gather_vector(centre, body_a);
    pair.inv_inertia_a = gather_inertia(body_a);
    if constexpr (two_bodies) {
      pair.centre_b = gather_vector(centre, body_b);
      pair.inv_inertia_b = gather_inertia(body_b);
    }
  }
  return pair;
}

template <class T, bool two_bodies, ContactKind kind>
typename ContactBuilder<T, two_bodies, kind>::Given ContactBuilder<T, two_bodies, kind>::read(
    const Manifold* manifolds, int point) const {
  const V zero = T::broadcast(0);
  Given given{{zero, zero, zero}, {zero, zero, T::broadcast(1)}, zero, zero, zero, zero, zero,
              {zero, zero, zero}};
  for (int lane = 0; lane < T::num_lanes; ++lane) {
    if (point >= manifolds[lane].num_points) continue;
    const model::Contact& contact = manifolds[lane].points[point];
    if constexpr (!Solver::central) {
      T::set(given.position.x, lane, static_cast<Scalar>(contact.position.x()));
      T::set(given.position.y, lane, static_cast<Scalar>(contact.position.y()));
      T::set(given.position.z, lane, static_cast<Scalar>(contact.position.z()));
    }
    T::set(given.normal.x, lane, static_cast<Scalar>(contact.normal.x()));
    T::set(given.normal.y, lane, static_cast<Scalar>(contact.normal.y()));
    T::set(given.normal.z, lane, static_cast<Scalar>(contact.normal.z()));
    T::set(given.depth, lane, static_cast<Scalar>(contact.depth));
    if constexpr (rubs) T::set(given.mu, lane, static_cast<Scalar>(contact.mu));
    T::set(given.restitution, lane, static_cast<Scalar>(contact.restitution));
    T::set(given.factor, lane, parameters_.sor_factor);
    if (manifolds[lane].forces == nullptr) continue;
    const model::ContactForce& force = manifolds[lane].forces[point];
    T::set(given.normal_force, lane, static_cast<Scalar>(force.normal));
    if constexpr (rubs) {
      T::set(given.friction_force.x, lane, static_cast<Scalar>(force.friction.x()));
      T::set(given.friction_force.y, lane, static_cast<Scalar>(force.friction.y()));
      T::set(given.friction_force.z, lane, static_cast<Scalar>(force.friction.z()));
    }
  }
  return given;
}

template <class T, bool two_bodies, ContactKind kind>
PBMPI_LANES typename ContactBuilder<T, two_bodies, kind>::Arms ContactBuilder<T, two_bodies, kind>::arms_of(
    const BodyPair& pair, const Given& given) const {
  const V zero = T::broadcast(0);
  Arms arms{{zero, zero, zero}, {zero, zero, zero}};
  if (!parameters_.turning) return arms;
  const Scalar share = parameters_.relaxes ? Scalar(0.5) : Scalar(0);
  const L3 to_surface = given.normal * (given.depth * T::broadcast(share));
  arms.a = given.position - to_surface - pair.centre_a;
  if constexpr (two_bodies) arms.b = given.position + to_surface - pair.centre_b;
  return arms;
}

template <class T, bool two_bodies, ContactKind kind>
void ContactBuilder<T, two_bodies, kind>::build_point(ContactSlot<T>& slot, const BodyPair& pair,
                                                      const Given& given, Point& point) const {
  const V zero = T::broadcast(0);
  const Arms arms = arms_of(pair, given);
  build_row(slot, pair, given.normal, arms, parameters_.soft_cfm / parameters_.h, given.factor, point.normal);
  const V carried = T::broadcast(parameters_.h * parameters_.warm_start);
  point.normal.impulse = given.normal_force * carried;
  const V outgoing = Solver::speed(point.normal, pair.motion_a, pair.motion_b);
  const V returns = parameters_.restitution ? given.restitution : zero;
  const V bounce = outgoing < T::broadcast(-parameters_.bounce_velocity) ? -returns * outgoing : zero;
  const V push = T::min(parameters_.push_rate * given.depth, T::broadcast(parameters_.push_limit));
  const V fastest = given.factor > zero ? T::max(-outgoing, push) : zero;
  slot.impact = fastest > T::broadcast(parameters_.impact_velocity) ? T::broadcast(1) : slot.impact;
  if constexpr (Solver::patched) {
    const V square = slip_square(pair, given, arms, outgoing);
    const Scalar least = parameters_.slip_velocity;
    slot.slides = square > T::broadcast(least * least) ? T::broadcast(1) : slot.slides;
  }
  point.bounce = bounce;
  // A gap (negative depth) lets the bodies approach until they touch.
  point.rhs = given.depth < zero ? given.depth / parameters_.h : T::max(push, bounce);
  keep_depth(point);
  point.depth = point.planned = given.depth;
  if constexpr (Solver::friction)
    build_friction(slot, pair, given, arms, given.friction_force, point.friction);
}

template <class T, bool two_bodies, ContactKind kind>
typename ContactBuilder<T, two_bodies, kind>::Arms ContactBuilder<T, two_bodies, kind>::middle_of(
    const PatchPart* parts, int num_points) {
  const V zero = T::broadcast(0), one = T::broadcast(1);
  constexpr Scalar least_force = static_cast<Scalar>(1e-25);  // [N] below any that bears something
  V pressure = zero, total = zero;
  for (int i = 0; i < num_points; ++i) pressure += parts[i].normal_force;
  const auto presses = pressure > T::broadcast(least_force);
  const Arms& first = parts[0].arms;
  Arms away{{zero, zero, zero}, {zero, zero, zero}};
  for (int i = 0; i < num_points; ++i) {
    const V weight = presses ? parts[i].normal_force : parts[i].is_there;
    total += weight;
    away.a = away.a + (parts[i].arms.a - first.a) * weight;
    away.b = away.b + (parts[i].arms.b - first.b) * weight;
  }
  const V share = 1 / (total > zero ? total : one);
  return {first.a + away.a * share, first.b + away.b * share};
}

/// The middle stays the same throughout the step. It is the previous step's centre of pressure: a twist about
/// a place that carries no load could not be written as forces of the points that do, and would be lost from
/// one step to the next. The remembered forces act at the middle as a force and a twist.
template <class T, bool two_bodies, ContactKind kind>
void ContactBuilder<T, two_bodies, kind>::build_patch(const BodyPair& pair, const Given& first,
                                                      const PatchPart* parts, Slot& slot,
                                                      Point* points) const {
  const V zero = T::broadcast(0), one = T::broadcast(1);
  const Arms middle = middle_of(parts, slot.num_points);
  L3 force{zero, zero, zero}, torque = force;
  V farthest = zero;
  slot.normal = first.normal;
  for (int i = 0; i < slot.num_points; ++i) {
    const L3 away = (parts[i].arms.a - middle.a) * parts[i].is_there;
    const L3 lever = away - slot.normal * dot(slot.normal, away);
    points[i].lever = lever;
    points[i].distance = T::sqrt(dot(lever, lever));
    farthest = T::max(farthest, points[i].distance);
    force = force + parts[i].friction_force;
    torque = torque + cross(lever, parts[i].friction_force);
  }
  const V size = T::sqrt(dot(first.position, first.position)) + T::sqrt(dot(middle.a, middle.a));
  slot.least_distance = farthest * T::broadcast(static_cast<Scalar>(1e-4)) +
                        size * T::broadcast(8 * std::numeric_limits<Scalar>::epsilon());
  build_friction(slot, pair, first, middle, force, slot.friction);
  slot.turn_a = pair.inv_inertia_a * slot.normal;
  V diagonal = dot(slot.normal, slot.turn_a);
  if constexpr (two_bodies) {
    slot.turn_b = pair.inv_inertia_b * slot.normal;
    diagonal += dot(slot.normal, slot.turn_b);
  }
  diagonal += T::broadcast(parameters_.cfm / parameters_.h);
  const auto turns = diagonal > zero;
  slot.twist_scale = turns ? first.factor / (turns ? diagonal : one) : zero;
  const Row &row0 = slot.friction.rows[0], &row1 = slot.friction.rows[1];
  V made0 = dot(slot.normal, row0.turn_a), made1 = dot(slot.normal, row1.turn_a);
  if constexpr (two_bodies) {
    made0 -= dot(slot.normal, row0.turn_b);
    made1 -= dot(slot.normal, row1.turn_b);
  }
  const auto is_idle = first.factor <= zero;
  const V per_factor = 1 / (is_idle ? one : first.factor);
  slot.lean[0] = (row0.scale * made0 + slot.friction.coupling * made1) * per_factor;
  slot.lean[1] = (slot.friction.coupling * made0 + row1.scale * made1) * per_factor;
  const V rest = diagonal - slot.lean[0] * made0 - slot.lean[1] * made1;
  const auto is_apart = rest > diagonal * T::broadcast(static_cast<Scalar>(1e-5));  // beyond rounding
  slot.free_twist_scale = is_apart ? first.factor / (is_apart ? rest : one) : zero;
  slot.twist = dot(slot.normal, torque) * T::broadcast(parameters_.h * parameters_.warm_start);
}

template <class T, bool two_bodies, ContactKind kind>
void ContactBuilder<T, two_bodies, kind>::build_friction(const ContactSlot<T>& slot, const BodyPair& pair,
                                                         const Given& given, const Arms& arms,
                                                         const L3& carried, Friction& friction) const {
  friction.mu = given.mu;
  L3 directions[2];
  plane_space<T>(given.normal, directions[0], directions[1]);
  const V per_force = T::broadcast(parameters_.h * parameters_.warm_start);
  const Scalar cfm = parameters_.cfm / parameters_.h;
  Row &row0 = friction.rows[0], &row1 = friction.rows[1];
  for (int i = 0; i < 2; ++i) {
    build_row(slot, pair, directions[i], arms, cfm, given.factor, friction.rows[i]);
    friction.rows[i].impulse = dot(directions[i], carried) * per_force;
  }
  friction.coupling = friction.slide = T::broadcast(0);
  if (!parameters_.cone) return;
  // Inverse of the 2 x 2 block, times the factor.
  V off = dot(row0.moment_a, row1.turn_a);
  if constexpr (two_bodies) off += dot(row0.moment_b, row1.turn_b);
  const V zero = T::broadcast(0), one = T::broadcast(1);
  const auto is_idle = given.factor <= zero;
  const V factor = is_idle ? one : given.factor;
  const V scale0 = row0.scale, scale1 = row1.scale;
  const V share = 1 / (factor - off * off * scale0 * scale1 / factor);
  const V sum = scale0 + scale1;
  friction.slide = scale0 * scale1 / (is_idle ? one : sum);
  friction.coupling = -off * scale0 * scale1 * share;
  row0.scale = scale0 * factor * share;
  row1.scale = scale1 * factor * share;
}

template <class T, bool two_bodies, ContactKind kind>
PBMPI_LANES void ContactBuilder<T, two_bodies, kind>::build_row(const ContactSlot<T>& slot,
                                                                const BodyPair& pair, const L3& direction,
                                                                const Arms& arms, Scalar cfm, const V& factor,
                                                                Row& row) {
  row.direction = direction;
  V diagonal = slot.inv_mass_a;
  if constexpr (!Solver::central) {
    row.moment_a = cross(arms.a, direction);
    row.turn_a = pair.inv_inertia_a * row.moment_a;
    diagonal += dot(row.moment_a, row.turn_a);
  }
  if constexpr (two_bodies && Solver::central) {
    diagonal += slot.inv_mass_b;
  } else if constexpr (two_bodies) {
    row.moment_b = -cross(arms.b, direction);
    row.turn_b = pair.inv_inertia_b * row.moment_b;
    diagonal += slot.inv_mass_b + dot(row.moment_b, row.turn_b);
  }
  row.scale = factor / (diagonal + cfm);
  row.impulse = T::broadcast(0);
}

template <class T, bool two_bodies, ContactKind kind>
void ContactBuilder<T, two_bodies, kind>::advance(const Slot& slot, Point* points) const {
  const Motion a = Solver::gather(bodies_->contact_twists, slot.row_a);
  const Motion b = two_bodies ? Solver::gather(bodies_->contact_twists, slot.row_b) : Motion{};
  const V zero = T::broadcast(0);
  const V per_h = T::broadcast(1 / parameters_.h), rate = T::broadcast(parameters_.push_rate);
  const V rest = T::broadcast(1 - parameters_.push_rate * parameters_.h);
  for (int i = 0; i < slot.num_points; ++i) {
    Point& point = points[i];
    point.depth = point.depth - Solver::speed(point.normal, a, b) * parameters_.h;
    point.planned = point.planned * rest;
    const V excess = T::max(point.depth - T::max(point.planned, zero), zero);
    // A gap (negative depth) lets the bodies approach until they touch.
    const V push = (point.depth > zero ? rate : per_h) * point.depth;
    point.rhs =
        parameters_.relaxes ? T::min(push, T::broadcast(parameters_.push_limit)) : push + excess * per_h;
    keep_depth(point);
  }
}

}  // namespace pbmpi::solver
