/// Energy that a world gains without a cause.
#pragma once

#include <cstdint>
#include <vector>

#include "model/model.h"
#include "model/state.h"
#include "stability/drive_work.h"
#include "stability/suspensions.h"

namespace pbmpi::stability {

/// Potential energy of all suspensions [J].
double spring_energy(const model::Model& model, const model::State& state);

/// Upper bound of the work [J] by which the energy (model::mechanical_energy()) may rise between the states
/// at the start of step `first_step` and `num_steps` steps later: what motors and steered axes can have
/// delivered, launches have added and suspensions have released. Negative where launches and suspensions took
/// more than that. Everything else, joints that break among it, does no work or takes energy away.
///
/// A motor delivers at most its largest force times the largest speed that its axis is known to have had: at
/// either state, or its target. Over a single step this bound is exact, because a step's impulse does the
/// work of the mean of the speeds before and after it.
double allowed_work(const model::Model& model, const model::State& before, const model::State& after,
                    std::int64_t first_step, int num_steps, double dt_s);

/// Sums gains as a CUSUM chart does (Page 1954): gain = max(0, gain + change of energy - allowed work). So
/// energy that friction or inelastic contacts took earlier pays for no later gain.
class EnergyGain {
 public:
  /// `model` is borrowed.
  EnergyGain(const model::Model& model, double dt_s);

  /// A state and its energy.
  struct At {
    const model::State& state;
    double energy_j = 0;  ///< model::mechanical_energy()
  };

  /// Takes `num_steps` steps from step `first_step` on into memory.energy_gain_j. What motors can have
  /// delivered is found out only where the rest has risen.
  void add(const At& before, const At& after, std::int64_t first_step, int num_steps,
           model::GuardMemory& memory) const;

 private:
  const model::Model* model_;
  DriveWork drives_;
  std::vector<Suspension> springs_;
};

}  // namespace pbmpi::stability
