/// Limits and motors of a joint's axes: their bounds and right-hand sides in a substep.
#pragma once

#include "solver/joints/joint_rows.h"
#include "solver/joints/joint_terms.h"

namespace pbmpi::solver {

template <class T>
class ControlRules {
 public:
  using V = typename T::V;
  using Scalar = typename T::Scalar;

  /// `h` [s]: length of the substep; `erp`: the share of a limit's error that it removes, no faster than
  /// `fastest` [rad/s] or [m/s].
  ControlRules(Scalar h, Scalar erp, Scalar fastest) : h_(h), k_(erp / h), fastest_(fastest) {}

  Scalar h() const { return h_; }
  /// [rad] or [m] How far off a limit already acts: it lets the axis approach until it is there.
  Scalar margin() const { return fastest_ < static_cast<Scalar>(huge_bound) ? fastest_ * h_ : 0; }

  /// `at_low_flag`, `at_high_flag`: 1 where the coordinate is at or past the limit, or not farther off than
  /// margin(), else 0. `place`: the coordinate [rad] or [m]; may be 0 where there is no limit and no pose to
  /// hold.
  PBMPI_LANES ControlState<V> decide(const AxisControl<V>& control, const V& at_low_flag,
                                     const V& at_high_flag, const V& place) const {
    const V zero = T::broadcast(0);
    const V bound = T::broadcast(static_cast<Scalar>(huge_bound));
    const V velocity = control.has_hold ? aim(control, place) : control.velocity;
    const V force = control.max_force * h_;
    ControlState<V> state{velocity, -force, force, velocity, zero, zero};
    if (!T::any(at_low_flag + at_high_flag)) return state;
    const auto at_low = at_low_flag != zero;
    const auto at_high = at_high_flag != zero;
    const auto locked = control.low == control.high;
    const V error = place - (at_low ? control.low : control.high);
    const V most = T::broadcast(fastest_), back = T::min(T::max(-k_ * error, -most), most);
    const auto is_off = at_low ? error > zero : error < zero;
    const V ahead = locked ? back : -error / h_;
    const V limited = is_off ? ahead : back;
    state.rhs = at_low ? limited : (at_high ? limited : velocity);
    const V relaxed = locked ? zero : (is_off ? ahead : zero);
    state.relaxed_rhs = at_low ? relaxed : (at_high ? relaxed : velocity);
    state.low = at_low ? (locked ? -bound : zero) : (at_high ? -bound : -force);
    state.high = at_low ? bound : (at_high ? (locked ? bound : zero) : force);
    // A motor at its limit is a constant torque, into the limit unless the motor turns away from it.
    const V at_rest = at_low ? force : -force;
    const V push = velocity > zero ? -force : (velocity < zero ? force : at_rest);
    state.push = at_low ? push : (at_high ? push : zero);
    state.push = locked ? zero : state.push;
    state.at_limit = at_low_flag + at_high_flag;
    return state;
  }

 private:
  /// The velocity that a motor aims at in this substep.
  V aim(const AxisControl<V>& control, const V& place) const {
    const V fastest = T::broadcast(1 / h_);
    return control.velocity - (control.hold_rate > fastest ? fastest : control.hold_rate) * place;
  }

  Scalar h_, k_, fastest_;
};

}  // namespace pbmpi::solver
