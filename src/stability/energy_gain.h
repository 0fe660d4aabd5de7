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
