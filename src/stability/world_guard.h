/// Guards one world frame by frame, and acts when a guard trips.
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

/// The state that a stepper has reached.
struct Reached {
  const model::State& state;
  const stepping::Observables& seen;
};

/// Guards check the ends of frames, using numbers that are measured there anyway. A suspicion is traced to
/// its step: the world is stepped again from the frame's start, by itself and step by step, with the same
/// bits. A suspicion that no single step confirms is dropped, for example where the straight path of a body
/// over a frame cuts a corner that its real path went around.
class WorldGuard {
 public:
  /// `settings` is borrowed.
  WorldGuard(int world, std::shared_ptr<const model::Model> model, const GuardSettings& settings);

  /// Takes in a state from the start of a run or from another rank, with the data that a guard needs of it.
  Watched begin(const model::State& state) const;

  /// Takes a world from the end of one frame to that of the next, `num_steps` steps from `first_step` on,
  /// where its stepper has reached `next`. With freeze and refine the world may get another state, in which
  /// case this returns true. `events`: what happened is appended. `targets`: those of the motors when the
  /// frame began.
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
