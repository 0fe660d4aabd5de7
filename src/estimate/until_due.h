/// The estimate that is due at a given time of each frame.
#pragma once

#include <map>
#include <memory>

#include "stepping/deadline_plan.h"
#include "stepping/estimator.h"
#include "stepping/stepper.h"

namespace pbmpi::estimate {

/// Begins the precise frame, step by step as long as there is time for coarse steps after it, and has another
/// estimator do these; where even these do not fit, the bodies glide. On a fast machine the estimate is the
/// precise result itself. The estimate depends on the clock and differs from run to run; the precise frames
/// do not.
class UntilDue final : public stepping::Estimator {
 public:
  /// `precise`, borrowed, computes the precise frames. `deadline_s`: from the start of a frame until its
  /// estimate is due. `dt_s`: length of a step.
  UntilDue(stepping::FrameStepper& precise, std::unique_ptr<stepping::Estimator> rest, double deadline_s,
           double dt_s)
      : precise_(&precise), rest_(std::move(rest)), plan_(deadline_s), dt_s_(dt_s) {}

  void estimate(std::span<const stepping::LocalWorld> worlds, std::int64_t step, int num_steps,
                core::PhaseTimes& times) override;
  const model::State& state(int world) const override {
    return steps_.coarse > 0 ? rest_->state(world) : held_.at(world);
  }
  stepping::EstimatedSteps steps() const override { return steps_; }

 private:
  void note_last_frame(std::span<const stepping::LocalWorld> worlds, std::int64_t step, int num_steps);
  void begin_precise(double start_s, int num_steps, core::PhaseTimes& times);
  void finish(std::span<const stepping::LocalWorld> worlds, double start_s, std::int64_t step, int num_steps,
              core::PhaseTimes& times);
  void glide(int num_steps, core::PhaseTimes& times);

  stepping::FrameStepper* precise_;
  std::unique_ptr<stepping::Estimator> rest_;
  stepping::DeadlinePlan plan_;
  double dt_s_;
  std::int64_t next_step_ = -1;       ///< after the last frame
  stepping::EstimatedSteps steps_;    ///< of the last estimate
  std::map<int, model::State> held_;  ///< the last estimate, unless it ends with coarse steps
};

}  // namespace pbmpi::estimate
