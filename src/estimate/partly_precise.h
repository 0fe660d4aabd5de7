/// The estimate that begins with steps of the precise frame.
#pragma once

#include <memory>
#include <vector>

#include "stepping/estimator.h"
#include "stepping/stepper.h"

namespace pbmpi::estimate {

/// Begins the precise frame, and has another estimator do the rest from there: later than an estimate of the
/// whole frame, and nearer to the precise result. The precise frame then continues from the begun steps, so
/// that nothing is computed twice.
class PartlyPrecise final : public stepping::Estimator {
 public:
  /// `precise`, borrowed, computes the precise frames. `num_steps`: number of precise steps of each frame.
  PartlyPrecise(stepping::FrameStepper& precise, std::unique_ptr<stepping::Estimator> rest, int num_steps)
      : precise_(&precise), rest_(std::move(rest)), num_precise_(num_steps) {}

  void estimate(std::span<const stepping::LocalWorld> worlds, std::int64_t step, int num_steps,
                core::PhaseTimes& times) override;
  const model::State& state(int world) const override { return rest_->state(world); }
  stepping::EstimatedSteps steps() const override {
    return {.precise = num_precise_, .coarse = rest_->steps().coarse};
  }

 private:
  stepping::FrameStepper* precise_;
  std::unique_ptr<stepping::Estimator> rest_;
  int num_precise_;
};

/// `worlds` after the steps of the frame that `precise` has begun.
std::vector<stepping::LocalWorld> begun_worlds(const stepping::FrameStepper& precise,
                                               std::span<const stepping::LocalWorld> worlds);

}  // namespace pbmpi::estimate
