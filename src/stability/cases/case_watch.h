/// Measures a run of a hard case, step by step.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "model/mechanics.h"
#include "model/model.h"
#include "model/state.h"
#include "stability/cases/hard_case.h"
#include "stability/energy_gain.h"
#include "stepping/observables.h"

namespace pbmpi::stability {

/// The measured result of a run of a case.
struct CaseMeasurement {
  std::array<double, num_metrics> metrics{};  ///< in the units of metric_table
  std::vector<double> expected_off;           ///< [expectations] distance from each; NaN: it was not reached
  /// [s] Time at which a metric first exceeded its broken limit; infinite if none did.
  double broken_at_s = std::numeric_limits<double>::infinity();
  double simulated_s = 0;  ///< less than the case's seconds if the run ended early
};

/// Sees all states of a run in order. The case and the model must outlive it.
class CaseWatch {
 public:
  /// Throws core::InputError if the case has an expectation of a body that the model lacks, or watches no
  /// body.
  CaseWatch(const HardCase& hard_case, const model::Model& model, double dt_s);

  /// Takes the state after step `step` (1 = after the first) and its observables. The states of a run come
  /// one by one, or every few steps.
  void see(const model::State& state, const stepping::Observables& seen, std::int64_t step);

  double metric(Metric metric) const { return now_.metrics[static_cast<std::size_t>(metric)]; }
  CaseMeasurement result() const { return now_; }

 private:
  void raise(Metric metric, double value);
  void see_bodies(const model::State& state, double time_s);
  void see_energy(const model::State& state, double energy_j, std::int64_t step);
  void see_momentum(const model::State& state, const model::Mechanics& mechanics);
  void see_joints(const model::State& state);
  void see_expected(const model::State& state, double time_s);
  void note_broken(double time_s);

  const HardCase* case_;
  const model::Model* model_;
  double dt_s_;
  std::vector<int> watched_;        ///< bodies
  std::vector<int> expected_body_;  ///< [expectations]
  model::State start_, before_;
  std::int64_t before_step_ = 0;
  double start_energy_j_ = 0, energy_j_ = 0;
  EnergyGain energy_gain_;
  model::MechanicsMeter mechanics_;
  model::GuardMemory memory_;
  model::Vec3 start_momentum_, start_spin_;
  double momentum_scale_ = 0, spin_scale_ = 0;
  double sum_of_squared_gaps_ = 0;
  std::int64_t num_gaps_ = 0;
  std::optional<model::State> halfway_;
  double halfway_s_ = 0;
  CaseMeasurement now_;
};

}  // namespace pbmpi::stability
