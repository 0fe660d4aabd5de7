/// Watches one world frame by frame, and deals with it when a guard trips.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "model/model.h"
#include "model/state.h"
#include "stability/guards.h"
#include "stability/on_blowup.h"
#include "stepping/motor_targets.h"
#include "stepping/observables.h"
#include "stepping/run_event.h"

namespace pbmpi::stability {

/// A world at the end of a frame, State::guard included.
struct Watched {
  model::State state;
  stepping::Observables seen;

  bool is_frozen() const { return state.guard.frozen_in >= 0; }
};

/// What a stepper has come to.
struct Reached {
  const model::State& state;
  const stepping::Observables& seen;
};

/// Guards look at the ends of frames, at numbers that are measured there anyway. What one of them suspects is
/// traced to its step: the world is stepped again from the frame's start, by itself and step by step, with
/// the same bits. A suspicion that no single step confirms is dropped, as when the straight way of a body
/// through a frame cuts a corner that its real way went round.
class WorldGuard {
 public:
  /// `settings` is borrowed.
  WorldGuard(int world, std::shared_ptr<const model::Model> model, const GuardSettings& settings);

  /// A state that comes from elsewhere, from the start of a run or from another rank, with what a guard wants
  /// to know of it.
  Watched begin(const model::State& state) const;

  /// Takes a world that moves from the end of one frame to that of the next, `num_steps` steps from
  /// `first_step` on, at which its stepper has `next`. With freeze and refine it may come to another state:
  /// true then. `events`: what happened is added. `targets`: what the motors aimed at when the frame began.
  bool end_frame(Watched& watched, const Reached& next, std::int64_t first_step, int num_steps,
                 std::vector<stepping::RunEvent>& events, const stepping::MotorTargets& targets = {}) const;

 private:
  class Replay;

  int world_;
  std::shared_ptr<const model::Model> model_;
  const GuardSettings* settings_;
  Guards guards_;
};

}  // namespace pbmpi::stability
