/// The estimate as a separate short run: another stepper, cheaper than the precise one.
#pragma once

#include <map>
#include <memory>
#include <set>

#include "stepping/estimator.h"
#include "stepping/stepper.h"

namespace pbmpi::estimate {

/// Estimates with `stepper`, e.g. of the same kind as the precise one with fewer iterations (the paper's
/// choice). Follows the worlds that come to and leave this rank; keeps a copy of their models.
class ShortRun final : public stepping::Estimator {
 public:
  explicit ShortRun(std::unique_ptr<stepping::WorldStepper> stepper) : stepper_(std::move(stepper)) {}

  void estimate(std::span<const stepping::LocalWorld> worlds, std::int64_t step, int num_steps,
                core::PhaseTimes& times) override;
  const model::State& state(int world) const override {
    const auto found = standing_.find(world);
    return found == standing_.end() ? stepper_->state(world) : found->second;
  }

 private:
  void follow(std::span<const stepping::LocalWorld> worlds, std::int64_t step);

  std::unique_ptr<stepping::WorldStepper> stepper_;
  std::set<int> worlds_;                  ///< ids of the worlds in stepper_
  std::map<int, model::State> standing_;  ///< states of worlds that stand still (model::GuardMemory)
};

}  // namespace pbmpi::estimate
