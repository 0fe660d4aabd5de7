/// Limits and motors of a joint's axes: their bounds and right-hand sides in a substep.
#pragma once

#include "solver/joints/joint_rows.h"
#include "solver/joints/joint_terms.h"

namespace pbmpi::solver {

/// What an axis does in a substep: it is at a limit (with its error), driven, or free.
template <class V>
struct alignas(sizeof(V)) ControlState {
  V rhs, low, high;  ///< of the row
  V relaxed_rhs;     ///< of the row in sweeps that correct no position error
  V push;            ///< of a motor at its limit: see Bounded
  V at_limit;        ///< 1: a limit holds; 0: a motor drives
};

template <class T>
class ControlRules {
 public:
  using V = typename T::V;
  using Scalar = typename T::Scalar;

  /// `h` [s]: length of the substep; `erp`: the share of a limit's error that it removes.
  ControlRules(Scalar h, Scalar erp) : h_(h), k_(erp / h) {}

  Scalar h() const { return h_; }

  /// `at_low_flag`, `at_high_flag`: 1 where the coordinate is at or past the limit, else 0. `place`: the
  /// coordinate [rad] or [m]; may be 0 where there is no limit and no pose to hold.
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
    state.rhs = at_low ? -k_ * error : (at_high ? -k_ * error : velocity);
    state.relaxed_rhs = at_low ? zero : (at_high ? zero : velocity);
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

  Scalar h_, k_;
};

template <class Row, class V>
PBMPI_LANES void set_bounds(const ControlState<V>& state, Bounded<Row, V>& row) {
  row.low = state.low;
  row.high = state.high;
  row.relaxed_rhs = state.relaxed_rhs;
  row.push = state.push;
  row.at_limit = state.at_limit;
}

}  // namespace pbmpi::solver
