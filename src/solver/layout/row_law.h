/// How stiff rows are: as springs with a frequency and a damping ratio, or by ODE's ERP and CFM.
#pragma once

#include <algorithm>
#include <limits>
#include <numbers>

namespace pbmpi::solver {

/// The most periods that springs may have in a substep. Stiffer springs rely on forces that a substep's few
/// sweeps have not found yet: walls and columns begin to tremble, chains and limits to swing up. The values
/// are those that keep most of scenes/hard stable (docs/stability.md). Rows that hold an orientation bear
/// more than rows that hold a place.
inline constexpr double most_contact_periods = 0.18, most_place_periods = 0.2, most_turn_periods = 0.25;

/// The largest damping ratio of joints that are solved exactly. They rely on no force that has not been
/// found.
inline constexpr double most_exact_damping = 0.7;

/// A constraint as a damped spring between bodies, whatever their masses.
struct Spring {
  /// 0: no spring, the scene's ERP and CFM hold; infinite: as stiff as most_periods allows.
  double frequency_hz = 0;
  double damping_ratio = 1;
  double most_periods = most_turn_periods;  ///< in a substep

  bool is_on() const { return frequency_hz > 0; }
  /// The frequency [Hz] in substeps of h [s].
  double frequency_in(double h) const { return std::min(frequency_hz, most_periods / h); }
  /// [s^2] By how much the spring then gives under an acceleration; 0 if there is no spring.
  double give_in(double h) const {
    if (!is_on()) return 0;
    const double w = 2 * std::numbers::pi * frequency_in(h);
    return 1 / (w * w);
  }
};

/// How a sweep changes the impulse p of a row with effective mass 1 / d and right-hand side rhs:
///   change = (rhs - J v) mass_share / d - relief p.
/// mass_share = 1 and relief = 0 make a rigid row.
template <class Scalar>
struct RowLaw {
  Scalar mass_share = 1, relief = 0;
  Scalar bias = 1;                                        ///< 0: position errors are not corrected
  Scalar most_push = std::numeric_limits<Scalar>::max();  ///< [m/s] fastest that contacts push out

  /// The law of a sweep that leaves position errors as they are.
  static RowLaw relaxing() { return {1, 0, 0, 0}; }
};

/// ERP and CFM follow from an implicit Euler step h [s] of the spring (E. Catto, "Soft constraints", GDC
/// 2011): its ERP is h w / (2 zeta + h w), its CFM relative to d is 1 / (h w (2 zeta + h w)). Where a step
/// stands for several shorter ones, the spring is no stiffer than it would be in those, so that resting
/// bodies sag equally however few steps they get.
class SpringStep {
 public:
  SpringStep(const Spring& spring, double h, double shorter_steps = 1) {
    const double angle = 2 * std::numbers::pi * h * spring.frequency_in(h / shorter_steps);
    const double resistance = 2 * spring.damping_ratio + angle;
    erp_ = angle / resistance;
    relative_cfm_ = 1 / (angle * resistance);
  }

  double erp() const { return erp_; }
  template <class Scalar>
  RowLaw<Scalar> law() const {
    const double total = 1 + relative_cfm_;
    return {static_cast<Scalar>(1 / total), static_cast<Scalar>(relative_cfm_ / total)};
  }

 private:
  double erp_, relative_cfm_;
};

}  // namespace pbmpi::solver
