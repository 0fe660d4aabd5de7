/// Measures how far a step's impulses and velocities are from the solution of its rows.
#pragma once

#include <algorithm>
#include <cmath>

#include "solver/contacts/contact_solver.h"
#include "stepping/observables.h"

namespace pbmpi::solver {

/// Measures the rows of one world as the last sweep left them, with the twists at that time. For the numbers
/// see stepping::Residuals. It goes lane by lane, since it is called on demand only.
template <class T>
class ResidualMeter {
 public:
  using V = typename T::V;
  using Scalar = typename T::Scalar;

  /// `h` [s]: length of a substep; `cfm` [s/kg]: the joints'; `contacts`: the parameters with which the
  /// contacts were built.
  ResidualMeter(Scalar h, double cfm, const ContactParameters<Scalar>& contacts)
      : cfm_(static_cast<Scalar>(cfm) / h), contacts_(contacts) {}

  /// Adds the rows of a joint in one lane.
  template <model::JointKind kind>
  void add_joint(const JointRows<T, kind>& rows, const BodyLanes<T>& bodies, int lane) {
    const Twist<V>&a = bodies.twists[rows.slot_a], &b = bodies.twists[rows.slot_b];
    for (const PointRows<V>& row : rows.points) {
      const Vec3L<V> speed = a.linear + cross(a.angular, row.arm_a) - b.linear - cross(b.angular, row.arm_b);
      add_free(line_, error(speed.x, row.rhs.x + row.ahead.x, cfm_, row.impulse.x, lane));
      add_free(line_, error(speed.y, row.rhs.y + row.ahead.y, cfm_, row.impulse.y, lane));
      add_free(line_, error(speed.z, row.rhs.z + row.ahead.z, cfm_, row.impulse.z, lane));
    }
    for (const LineRow<V>& row : rows.lines) add_free(line_, error(row, a, b, lane));
    for (const AxisRow<V>& row : rows.axes) add_free(axis_, error(row, a, b, lane));
    for_each_control(rows, [&](const auto& control, std::size_t i) {
      if (rows.control_on[i]) add_bounded(rows, control, a, b, lane);
    });
  }

  /// Adds the contacts of a slot for which is_wanted(lane, point).
  template <class Slot, class Point, class IsWanted>
  void add_contacts(const Slot& slot, const Point* points, const TwistRows<T>& twists, IsWanted is_wanted) {
    using Solver = ContactSolver<T, Point::two_bodies, Point::kind>;
    using Motion = typename Solver::Motion;
    const Motion a = Solver::gather(twists, slot.row_a);
    const Motion b = Point::two_bodies ? Solver::gather(twists, slot.row_b) : Motion{};
    for (int i = 0; i < slot.num_points; ++i) {
      for (int lane = 0; lane < T::num_lanes; ++lane) {
        if (is_wanted(lane, i)) add_contact<Solver>(points[i], a, b, lane);
      }
    }
    if constexpr (Solver::patched) {
      for (int lane = 0; lane < T::num_lanes; ++lane) {
        if (is_wanted(lane, 0)) add_patch<Solver>(slot, points, a, b, lane);
      }
    }
  }

  stepping::Residuals result() const {
    return {line_.free, axis_.free, complementarity_, line_.natural, axis_.natural};
  }

 private:
  struct Largest {
    double free = 0, natural = 0;
  };

  /// -w = rhs - J v - cfm p.
  static double error(const V& speed, const V& rhs, double cfm, const V& impulse, int lane) {
    return T::get(rhs, lane) - T::get(speed, lane) - cfm * T::get(impulse, lane);
  }
  double error(const LineRow<V>& row, const Twist<V>& a, const Twist<V>& b, int lane) const {
    return error(relative_speed(row, a, b), row.rhs + row.ahead, T::get(row.cfm, lane), row.impulse, lane);
  }
  double error(const AxisRow<V>& row, const Twist<V>& a, const Twist<V>& b, int lane) const {
    return error(dot(row.axis, a.angular - b.angular), row.rhs + row.ahead, cfm_, row.impulse, lane);
  }

  /// A NaN stays: it is not a small residual.
  static void raise(double& most, double value) {
    if (!(std::abs(value) <= most)) most = std::abs(value);
  }
  static void add_free(Largest& largest, double error) {
    raise(largest.free, error);
    raise(largest.natural, error);
  }
  /// scale = factor / d.
  double natural(double error, double impulse, double low, double high, double scale) const {
    const double per_d = scale / contacts_.sor_factor;
    return (std::clamp(impulse + error * per_d, low, high) - impulse) / per_d;
  }
  template <class Rows, class Row>
  void add_bounded(const Rows& rows, const Bounded<Row, V>& bounded, const Twist<V>& a, const Twist<V>& b,
                   int lane) {
    const double low = T::get(bounded.low, lane), high = T::get(bounded.high, lane);
    if (!(low < high)) return;  // no row in this lane
    Largest& largest = std::is_same_v<Row, AxisRow<V>> ? axis_ : line_;
    const double per_d = contacts_.sor_factor / T::get(diagonal(rows, bounded.row), lane);
    raise(largest.natural,
          natural(error(bounded.row, a, b, lane), T::get(bounded.row.impulse, lane), low, high, per_d));
  }
  /// J M^-1 J^T + cfm.
  template <class Rows>
  V diagonal(const Rows&, const AxisRow<V>& row) const {
    return dot(row.axis, row.turn_a + row.turn_b) + cfm_;
  }
  template <class Rows>
  V diagonal(const Rows& rows, const LineRow<V>& row) const {
    return rows.inv_mass_a + rows.inv_mass_b + dot(row.moment_a, row.turn_a) + dot(row.moment_b, row.turn_b) +
           row.cfm;
  }
  template <class Solver>
  void add_contact(const typename Solver::Point& point, const typename Solver::Motion& a,
                   const typename Solver::Motion& b, int lane) {
    const auto row_natural = [&](const auto& row, double error, double low, double high) {
      return natural(error, T::get(row.impulse, lane), low, high, T::get(row.scale, lane));
    };
    const double impulse = T::get(point.normal.impulse, lane);
    const double normal = error(Solver::speed(point.normal, a, b), point.rhs,
                                contacts_.soft_cfm / contacts_.h, point.normal.impulse, lane);
    raise(complementarity_, impulse * normal);
    raise(line_.natural, row_natural(point.normal, normal, 0, huge_bound));
    if constexpr (Solver::friction)
      add_friction<Solver>(point.friction, T::get(point.friction.mu, lane) * impulse, a, b, lane);
  }
  template <class Solver>
  void add_friction(const typename Solver::Friction& friction, double bound, const typename Solver::Motion& a,
                    const typename Solver::Motion& b, int lane) {
    double errors[2], impulses[2];
    read_friction<Solver>(friction, a, b, lane, errors, impulses);
    if (contacts_.cone) {
      raise(line_.natural,
            ball_natural(errors, impulses, bound, T::get(friction.slide, lane) / contacts_.sor_factor));
      return;
    }
    for (int k = 0; k < 2; ++k)
      raise(line_.natural,
            natural(errors[k], impulses[k], -bound, bound, T::get(friction.rows[k].scale, lane)));
  }
  /// Writes the first two of each.
  template <class Solver>
  void read_friction(const typename Solver::Friction& friction, const typename Solver::Motion& a,
                     const typename Solver::Motion& b, int lane, double* errors, double* impulses) const {
    for (int k = 0; k < 2; ++k) {
      const auto& row = friction.rows[k];
      impulses[k] = T::get(row.impulse, lane);
      errors[k] =
          error(Solver::speed(row, a, b), T::broadcast(0), contacts_.cfm / contacts_.h, row.impulse, lane);
    }
  }
  /// Natural map of rows with a common ball as bounds.
  template <std::size_t num_rows>
  static double ball_natural(const double (&errors)[num_rows], const double (&impulses)[num_rows],
                             double bound, double per_d) {
    double after[num_rows], square = 0, moved = 0;
    for (std::size_t k = 0; k < num_rows; ++k) {
      after[k] = impulses[k] + errors[k] * per_d;
      square += after[k] * after[k];
    }
    const double share = square > bound * bound ? bound / std::sqrt(square) : 1;
    for (std::size_t k = 0; k < num_rows; ++k)
      moved += (after[k] * share - impulses[k]) * (after[k] * share - impulses[k]);
    return std::sqrt(moved) / per_d;
  }
  /// See ContactSolver::solve_patch().
  template <class Solver>
  void add_patch(const typename Solver::Slot& slot, const typename Solver::Point* points,
                 const typename Solver::Motion& a, const typename Solver::Motion& b, int lane) {
    double force = 0, torque = 0;
    for (int i = 0; i < slot.num_points; ++i) {
      const double impulse = T::get(points[i].normal.impulse, lane);
      force += impulse;
      torque += impulse * T::get(points[i].distance, lane);
    }
    const double bound = T::get(slot.friction.mu, lane) * force;
    if (!(torque > force * T::get(slot.least_distance, lane)))
      return add_friction<Solver>(slot.friction, bound, a, b, lane);
    const double distance = torque / force;
    double errors[3], impulses[3];
    read_friction<Solver>(slot.friction, a, b, lane, errors, impulses);
    impulses[2] = T::get(slot.twist, lane) / distance;
    errors[2] = distance * error(Solver::twist_speed(slot, a, b), T::broadcast(0),
                                 contacts_.cfm / contacts_.h, slot.twist, lane);
    const double step = std::min<double>(T::get(slot.friction.slide, lane),
                                         T::get(slot.twist_scale, lane) / (distance * distance));
    raise(line_.natural, ball_natural(errors, impulses, bound, step / contacts_.sor_factor));
  }

  Scalar cfm_;
  ContactParameters<Scalar> contacts_;
  Largest line_, axis_;
  double complementarity_ = 0;
};

}  // namespace pbmpi::solver
