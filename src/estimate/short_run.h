/// The estimate as a short run of its own: another stepper, cheaper than the precise one.
#pragma once

#include <memory>
#include <set>

#include "model/estimator.h"
#include "model/stepper.h"

namespace pbmpi::estimate {

/// Estimates with `stepper`, e.g. of the same kind as the precise one with fewer iterations (the paper's
/// choice). Follows the worlds that come to and leave this rank; keeps a copy of their models.
///
/// A stepper that can show its state in mid-solve needs no second assembly: SameSolve.
class ShortRun final : public model::Estimator {
 public:
  explicit ShortRun(std::unique_ptr<model::WorldStepper> stepper) : stepper_(std::move(stepper)) {}

  void estimate(std::span<const model::LocalWorld> worlds, std::int64_t step, int num_steps,
                core::PhaseTimes& times) override;
  const model::State& state(int world) const override { return stepper_->state(world); }

 private:
  void follow(std::span<const model::LocalWorld> worlds, std::int64_t step);

  std::unique_ptr<model::WorldStepper> stepper_;
  std::set<int> worlds_;  ///< that stepper_ has
};

}  // namespace pbmpi::estimate
