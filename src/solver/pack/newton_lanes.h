/// Translates between a pack's lanes and RowSystem.
#pragma once

#include <algorithm>
#include <array>
#include <functional>
#include <utility>
#include <vector>

#include "solver/contacts/contact_groups.h"
#include "solver/newton/row_system.h"
#include "solver/pack/world_lanes.h"

namespace pbmpi::solver {

/// Ends the sweeps over rigid rows, with friction in cones, by RowSystem::solve(). It puts a world's rows in
/// an order that does not depend on the lanes.
template <class T>
class NewtonLanes {
 public:
  using V = typename T::V;
  using Scalar = typename T::Scalar;

  /// `cfm`: the joints' CFM divided by the step; `contacts`: the parameters with which the rows were built.
  NewtonLanes(Scalar cfm, const ContactParameters<Scalar>& contacts) : cfm_(cfm), parameters_(contacts) {}

  /// Changes impulses and the twists in the slots.
  void solve(WorldLanes<T>& worlds, ContactGroups<T>& contacts);

 private:
  using Rows = std::array<SystemRow, 3>;
  /// Where a row's impulse goes back to.
  struct Home {
    V* impulse;
    int lane, row;
  };
  /// A contact point; `contact` gives its place in the canonical order.
  struct Touch {
    const model::Contact* contact;
    Rows rows;
    std::array<V*, 3> homes;
    double mu;
    int num_rows, lane;
  };
  enum class Law { held, bounded };

  void collect(const WorldLanes<T>& worlds, ContactGroups<T>& contacts);
  template <class Solver, class Point>
  Touch touch(const ContactSlot<T>& slot, Point& point, const Manifold& manifold, int lane) const;
  template <class Solver, class Row>
  SystemRow contact_row(const ContactSlot<T>& slot, const Row& row, const Manifold& manifold, int lane,
                        double rhs, double cfm) const;
  void solve_world(WorldLanes<T>& worlds, int world);
  template <model::JointKind kind>
  void add_joint(JointRows<T, kind>& rows, int lane);
  void add(const Touch& touch);
  /// Adds a held row, unless its joint is broken.
  void hold(SystemRow row, const V& holds, V& impulse, int lane);
  template <class Row>
  void bound(const Bounded<Row, V>& bounded, SystemRow row, V& impulse, int lane);

  int body_at(int slot, int lane) const {
    return slot * T::num_lanes + lane < static_cast<int>(body_at_.size())
               ? body_at_[static_cast<std::size_t>(slot * T::num_lanes + lane)]
               : -1;
  }
  static SixVector six(const Vec3L<V>& linear, const Vec3L<V>& angular, int lane, double linear_scale = 1,
                       double angular_scale = 1) {
    return {linear_scale * T::get(linear.x, lane),   linear_scale * T::get(linear.y, lane),
            linear_scale * T::get(linear.z, lane),   angular_scale * T::get(angular.x, lane),
            angular_scale * T::get(angular.y, lane), angular_scale * T::get(angular.z, lane)};
  }
  template <class Rows_>
  SystemRow row_of(const Rows_& rows, int lane, const V& rhs, const V& impulse, double cfm) const {
    SystemRow row;
    row.a = body_at(rows.slot_a, lane);
    row.b = body_at(rows.slot_b, lane);
    row.rhs = T::get(rhs, lane);
    row.cfm = cfm;
    row.impulse = T::get(impulse, lane);
    return row;
  }
  template <class Rows_>
  SystemRow line_row(const Rows_& rows, const LineRow<V>& line, int lane) const;
  template <class Rows_>
  SystemRow axis_row(const Rows_& rows, const AxisRow<V>& axis, int lane) const;

  Scalar cfm_;
  ContactParameters<Scalar> parameters_;
  std::vector<int> body_at_;  ///< [slots][num_lanes] index of the body at a place in its world; -1: none
  std::vector<std::vector<Touch>> touches_;  ///< [num_worlds]
  RowSystem system_;
  std::vector<Home> homes_;  ///< of the system's rows
};

template <class T>
void NewtonLanes<T>::solve(WorldLanes<T>& worlds, ContactGroups<T>& contacts) {
  body_at_.assign(static_cast<std::size_t>(worlds.places.num_slots() * T::num_lanes), -1);
  for (int world = 0; world < worlds.num_worlds(); ++world) {
    for (int body = 0; body < worlds.model(world).num_bodies(); ++body) {
      const LanePlace at = worlds.places.body(world, body);
      body_at_[static_cast<std::size_t>(at.slot * T::num_lanes + at.lane)] = body;
    }
  }
  collect(worlds, contacts);
  for (int world = 0; world < worlds.num_worlds(); ++world) solve_world(worlds, world);
}

template <class T>
void NewtonLanes<T>::collect(const WorldLanes<T>& worlds, ContactGroups<T>& contacts) {
  touches_.assign(static_cast<std::size_t>(worlds.num_worlds()), {});
  contacts.change_slots([&](const ContactSlot<T>& slot, auto* points, const Manifold* manifolds) {
    using Point = std::remove_reference_t<decltype(*points)>;
    using Solver = ContactSolver<T, Point::two_bodies, Point::kind>;
    for (int lane = 0; lane < T::num_lanes; ++lane) {
      const Manifold& manifold = manifolds[lane];
      const int world = manifold.points == nullptr ? -1 : worlds.places.world_at(manifold.a);
      if (world < 0) continue;
      for (int i = 0; i < manifold.num_points; ++i) {
        Touch found = touch<Solver>(slot, points[i], manifold, lane);
        found.contact = manifold.points + i;
        touches_[static_cast<std::size_t>(world)].push_back(found);
      }
    }
  });
  for (std::vector<Touch>& touches : touches_) std::ranges::sort(touches, std::less<>(), &Touch::contact);
}

template <class T>
template <class Solver, class Row>
SystemRow NewtonLanes<T>::contact_row(const ContactSlot<T>& slot, const Row& row, const Manifold& manifold,
                                      int lane, double rhs, double cfm) const {
  SystemRow result;
  result.a = body_at(manifold.a.slot, manifold.a.lane);
  if constexpr (Solver::Point::two_bodies) result.b = body_at(manifold.b.slot, manifold.b.lane);
  result.rhs = rhs;
  result.cfm = cfm;
  result.impulse = T::get(row.impulse, lane);
  Vec3L<V> moment_a{}, turn_a{}, moment_b{}, turn_b{};
  if constexpr (!Solver::central) {
    moment_a = row.moment_a;
    turn_a = row.turn_a;
    if constexpr (Solver::Point::two_bodies) {
      moment_b = row.moment_b;
      turn_b = row.turn_b;
    }
  }
  result.jacobian_a = six(row.direction, moment_a, lane);
  result.response_a = six(row.direction, turn_a, lane, T::get(slot.inv_mass_a, lane));
  if constexpr (Solver::Point::two_bodies) {
    result.jacobian_b = six(row.direction, moment_b, lane, -1);
    result.response_b = six(row.direction, turn_b, lane, -T::get(slot.inv_mass_b, lane));
  }
  return result;
}

template <class T>
template <class Solver, class Point>
typename NewtonLanes<T>::Touch NewtonLanes<T>::touch(const ContactSlot<T>& slot, Point& point,
                                                     const Manifold& manifold, int lane) const {
  Touch found{nullptr, {}, {&point.normal.impulse, nullptr, nullptr}, 0, 1, lane};
  found.rows[0] = contact_row<Solver>(slot, point.normal, manifold, lane, T::get(point.rhs, lane),
                                      parameters_.soft_cfm / parameters_.h);
  if constexpr (Solver::friction) {
    found.mu = T::get(point.friction.mu, lane);
    found.num_rows = 3;
    for (std::size_t k = 0; k < 2; ++k) {
      auto& row = point.friction.rows[k];
      found.rows[k + 1] = contact_row<Solver>(slot, row, manifold, lane, 0, parameters_.cfm / parameters_.h);
      found.homes[k + 1] = &row.impulse;
    }
  }
  return found;
}

template <class T>
void NewtonLanes<T>::solve_world(WorldLanes<T>& worlds, int world) {
  std::vector<SixVector> twists;
  for (int body = 0; body < worlds.model(world).num_bodies(); ++body) {
    const LanePlace at = worlds.places.body(world, body);
    const Twist<V>& twist = worlds.bodies.twists[at.slot];
    twists.push_back(six(twist.linear, twist.angular, at.lane));
  }
  system_.start(std::move(twists));
  homes_.clear();
  worlds.change_joint_rows(world, [&](auto& rows, int lane) { add_joint(rows, lane); });
  for (const Touch& touch : touches_[static_cast<std::size_t>(world)]) add(touch);
  if (homes_.empty()) return;
  system_.solve();
  for (const Home& home : homes_)
    T::set(*home.impulse, home.lane, static_cast<Scalar>(system_.impulse(home.row)));
  for (int body = 0; body < worlds.model(world).num_bodies(); ++body) {
    if (!worlds.moves(world, body)) continue;
    const LanePlace at = worlds.places.body(world, body);
    Twist<V>& twist = worlds.bodies.twists[at.slot];
    const SixVector& solved = system_.twist(body);
    std::size_t i = 0;
    for (V* number : {&twist.linear.x, &twist.linear.y, &twist.linear.z, &twist.angular.x, &twist.angular.y,
                      &twist.angular.z})
      T::set(*number, at.lane, static_cast<Scalar>(solved[i++]));
  }
}

template <class T>
template <class Rows_>
SystemRow NewtonLanes<T>::line_row(const Rows_& rows, const LineRow<V>& line, int lane) const {
  SystemRow row = row_of(rows, lane, line.rhs + line.ahead, line.impulse, T::get(line.cfm, lane));
  row.jacobian_a = six(line.direction, line.moment_a, lane);
  row.jacobian_b = six(line.direction, line.moment_b, lane, -1);
  row.response_a = six(line.direction, line.turn_a, lane, T::get(rows.inv_mass_a, lane));
  row.response_b = six(line.direction, line.turn_b, lane, -T::get(rows.inv_mass_b, lane));
  return row;
}

template <class T>
template <class Rows_>
SystemRow NewtonLanes<T>::axis_row(const Rows_& rows, const AxisRow<V>& axis, int lane) const {
  const Vec3L<V> none{};
  SystemRow row = row_of(rows, lane, axis.rhs + axis.ahead, axis.impulse, cfm_);
  row.jacobian_a = six(none, axis.axis, lane);
  row.jacobian_b = six(none, axis.axis, lane, 1, -1);
  row.response_a = six(none, axis.turn_a, lane);
  row.response_b = six(none, axis.turn_b, lane, 1, -1);
  return row;
}

template <class T>
template <model::JointKind kind>
void NewtonLanes<T>::add_joint(JointRows<T, kind>& rows, int lane) {
  const V zero = T::broadcast(0), one = T::broadcast(1);
  const Vec3L<V> units[3] = {{one, zero, zero}, {zero, one, zero}, {zero, zero, one}};
  for (PointRows<V>& point : rows.points) {
    const V rhs[3] = {point.rhs.x + point.ahead.x, point.rhs.y + point.ahead.y, point.rhs.z + point.ahead.z};
    V* const impulse[3] = {&point.impulse.x, &point.impulse.y, &point.impulse.z};
    for (int k = 0; k < 3; ++k) {
      SystemRow row = row_of(rows, lane, rhs[k], *impulse[k], cfm_);
      row.jacobian_a = six(units[k], cross(point.arm_a, units[k]), lane);
      row.jacobian_b = six(units[k], cross(point.arm_b, units[k]), lane, -1, -1);
      row.response_a = six(units[k], point.turn_a[k], lane, T::get(rows.inv_mass_a, lane));
      row.response_b = six(units[k], point.turn_b[k], lane, -T::get(rows.inv_mass_b, lane), -1);
      hold(row, rows.holds, *impulse[k], lane);
    }
  }
  for (LineRow<V>& line : rows.lines) hold(line_row(rows, line, lane), rows.holds, line.impulse, lane);
  for (AxisRow<V>& axis : rows.axes) hold(axis_row(rows, axis, lane), rows.holds, axis.impulse, lane);
  for (std::size_t i = 0; i < rows.axis_controls.size(); ++i) {
    auto& control = rows.axis_controls[i];
    if (rows.control_on[i]) bound(control, axis_row(rows, control.row, lane), control.row.impulse, lane);
  }
  for (std::size_t i = 0; i < rows.line_controls.size(); ++i) {
    auto& control = rows.line_controls[i];
    if (rows.control_on[i]) bound(control, line_row(rows, control.row, lane), control.row.impulse, lane);
  }
}

template <class T>
void NewtonLanes<T>::hold(SystemRow row, const V& holds, V& impulse, int lane) {
  if (!(T::get(holds, lane) > 0)) return;
  homes_.push_back({&impulse, lane, system_.add_held(row)});
}

/// A row without room between its bounds does not exist in this lane.
template <class T>
template <class Row>
void NewtonLanes<T>::bound(const Bounded<Row, V>& bounded, SystemRow row, V& impulse, int lane) {
  const double low = T::get(bounded.low, lane), high = T::get(bounded.high, lane);
  if (!(low < high)) return;
  homes_.push_back({&impulse, lane, system_.add_bounded(row, low, high)});
}

template <class T>
void NewtonLanes<T>::add(const Touch& touch) {
  if (touch.num_rows == 1) {
    homes_.push_back({touch.homes[0], touch.lane, system_.add_bounded(touch.rows[0], 0, huge_bound)});
    return;
  }
  const int first = system_.add_contact(touch.rows, touch.mu);
  for (std::size_t k = 0; k < 3; ++k)
    homes_.push_back({touch.homes[k], touch.lane, first + static_cast<int>(k)});
}

}  // namespace pbmpi::solver
