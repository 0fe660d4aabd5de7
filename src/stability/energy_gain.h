/// Energy that a world gains without a cause.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "model/model.h"
#include "model/state.h"

namespace pbmpi::stability {

/// The model's events at the start of each of the `num_steps` steps from `first_step` on.
inline std::span<const model::Event> events_in(const model::Model& model, std::int64_t first_step,
                                               std::int64_t num_steps) {
  const auto begin = std::ranges::lower_bound(model.events, first_step, {}, &model::Event::step);
  const auto end = std::ranges::lower_bound(model.events, first_step + num_steps, {}, &model::Event::step);
  return {begin, end};
}

/// Upper bound of the work that motors and steered axes deliver between two states. Keeps only axes that a
/// motor or a steer event drives at any time, with the data that the bound needs.
class DriveWork {
 public:
  DriveWork(const model::Model& model, double dt_s);

  /// Upper bound of the work [J] delivered by the `num_steps` steps from `first_step` on, which end in
  /// `after`; joints that are broken in `before` deliver none. See allowed_work().
  double most(const model::State& before, const model::State& after, std::int64_t first_step,
              int num_steps) const;

 private:
  struct Axis {
    std::size_t joint = 0;
    int body_a = 0, body_b = model::no_body;
    int holder = model::no_body;  ///< body in whose frame the direction is fixed
    model::Vec3 direction;        ///< unit, in the holder's frame
    bool slides = false;
    double inertia = 0;                ///< [kg m^2] of a steered axis: the lighter body's largest
    model::AxisMotor motor;            ///< at the start
    std::vector<model::Event> events;  ///< motor and steer events of the axis, by step
  };
  struct Drive;

  static Drive drive_of(const Axis& axis, std::int64_t first_step, int num_steps);
  static double speed_of(const Axis& axis, const model::State& state);

  double dt_s_;
  std::vector<Axis> axes_;  ///< by joint and axis
};

/// A suspension that is not rigid, with the contiguous data from which its energy follows.
struct Suspension {
  std::size_t joint = 0;
  int body_a = 0, body_b = model::no_body;
  model::Vec3 anchor_a, anchor_b;  ///< [m], frames of the bodies
  model::Vec3 axis;                ///< unit, frame of a
  double stiffness = 0;            ///< [N/m]
};

/// The suspensions, by joint.
std::vector<Suspension> suspensions_of(const model::Model& model);

/// Potential energy [J]; 0 once its joint is broken.
double energy_of(const Suspension& suspension, const model::State& state);

/// Potential energy of all suspensions [J].
double spring_energy(const model::Model& model, const model::State& state);

/// Upper bound of the work [J] by which the energy (model::mechanical_energy()) may rise from the state at
/// the start of step `first_step` to the state `num_steps` steps later: the work that motors and steered axes
/// can have delivered, launches have added and suspensions have released. Negative where launches and
/// suspensions took more than that. Everything else, including joints that break, does no work or removes
/// energy.
///
/// A motor delivers at most its largest force times the largest speed that its axis is known to have had: in
/// either state, or as its target. Over a single step this bound is exact, because the work of a step's
/// impulse is the impulse times the mean of the speeds before and after it.
double allowed_work(const model::Model& model, const model::State& before, const model::State& after,
                    std::int64_t first_step, int num_steps, double dt_s);

/// Sums gains as a CUSUM chart does (Page 1954): gain = max(0, gain + change of energy - allowed work).
/// Energy that friction or inelastic contacts removed earlier therefore does not offset a later gain.
class EnergyGain {
 public:
  /// `model` is borrowed.
  EnergyGain(const model::Model& model, double dt_s);

  /// A state and its energy.
  struct At {
    const model::State& state;
    double energy_j = 0;  ///< model::mechanical_energy()
  };

  /// Adds `num_steps` steps from step `first_step` on to memory.energy_gain_j. The work of motors is computed
  /// only where the rest of the balance has risen.
  void add(const At& before, const At& after, std::int64_t first_step, int num_steps,
           model::GuardMemory& memory) const;

 private:
  const model::Model* model_;
  DriveWork drives_;
  std::vector<Suspension> springs_;
};

}  // namespace pbmpi::stability
