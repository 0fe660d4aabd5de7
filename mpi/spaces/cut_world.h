/// One world over the ranks of a communicator: each rank owns collision spaces and the bodies in them.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/clock.h"
#include "core/traffic.h"
#include "model/state.h"
#include "mpi/comm/agreement.h"
#include "mpi/comm/communicator.h"
#include "mpi/frame/run_settings.h"
#include "mpi/spaces/plan/reassign_spaces.h"
#include "mpi/spaces/plan/space_ownership.h"
#include "mpi/spaces/space_rebalancer.h"
#include "mpi/spaces/step/space_step.h"
#include "stability/world_guard.h"
#include "stepping/run_event.h"
#include "stepping/space_stepper.h"

namespace pbmpi::mpi {

/// The estimate of a world that is cut into spaces (FEEC): a short run by all ranks together, with a stepper
/// and messages of its own, from the precise state of the previous frame.
class SpaceEstimate {
 public:
  /// All borrowed.
  SpaceEstimate(const Communicator& comm, stepping::SpaceStepper& stepper, ErrorHold& errors,
                int steps_per_frame);

  /// Collective. Estimates the frame from `start`, the rank's copy of the precise state at the start of
  /// `step`: root needs all rows, the other ranks those of their own spaces.
  void run(const SpaceOwnership& ownership, const model::State& start, std::int64_t step,
           core::PhaseTimes& times);
  /// Takes this precise state as the estimate: that of a world that stands still.
  void take(const model::State& precise) { state_ = precise; }

  const model::State& state() const { return state_; }  ///< of the last estimate, on root
  core::Traffic take_traffic() { return step_.take_traffic(); }

 private:
  const Communicator* comm_;
  stepping::SpaceStepper* stepper_;
  SpaceStep step_;
  int steps_per_frame_;
  model::State state_;
};

/// Steps its world frame by frame (step/space_step.h describes a step). After each frame root of the
/// communicator has the whole state, guards the world, and decides when spaces change their owner. The result
/// is that of the undecomposed world, bit for bit.
///
/// Every call is made by all ranks of the communicator, unless it says otherwise; worlds that share a
/// communicator are called in one order by all of its ranks. An error on one rank is held in `errors`, and
/// messages are exchanged regardless.
class CutWorld {
 public:
  /// All borrowed. `owners` [num_spaces]: the owner of each space at the start.
  CutWorld(const Communicator& comm, stepping::SpaceStepper& stepper, ErrorHold& errors,
           const WorldRunSettings& settings, std::vector<int> owners);

  /// Sets the world to `state`, the same on every rank, after `steps_done` steps.
  void begin(const model::State& state, std::int64_t steps_done);

  /// Makes root step the world again by itself where a guard suspects a defect. `number`: that of the world
  /// in its ensemble; `settings` is borrowed. To be called after begin().
  void watch(int number, const stability::GuardSettings& settings);

  /// Estimates frames with a stepper of the same world and messages of `comm`, as SpaceEstimate describes.
  /// Borrowed.
  void estimate_with(const Communicator& comm, stepping::SpaceStepper& stepper);
  void estimate(core::PhaseTimes& times);                                     ///< estimates the next frame
  const model::State& estimated_state() const { return estimate_->state(); }  ///< on root

  /// Does the steps of a frame.
  void advance(core::PhaseTimes& times);
  double cost_s() const { return estimate_s_ + frame_s_; }  ///< useful time of this rank in the last frame

  // On root, after advance().
  const model::State& state() const { return stepper_->state(); }
  const model::State& saved_state() const;  ///< the state with its guard's memory, as it is hashed and saved
  const stepping::Observables& observables() const { return observables_; }
  const stepping::StepContacts* contacts() const;  ///< of the last step if recorded; else null
  std::vector<stepping::RunEvent> take_events() { return std::exchange(events_, {}); }
  bool is_mended() const { return is_mended_; }  ///< a guard has replaced the result of the ranks

  /// Replaces the state of every rank with root's mended state.
  void share_mended();

  /// On root. Plans which spaces are to change their owner; returns their number.
  std::int64_t plan_moves(bool may_move);
  /// Makes the moves planned on root.
  void make_moves();
  const Reassignment& planned() const { return planned_; }  ///< on root

  const model::Model& model() const { return stepper_->model(); }
  const SpaceOwnership& ownership() const { return ownership_; }  ///< at present
  core::Traffic take_traffic();

  /// Called after each step with the contacts that this rank solved. For tests.
  using StepHook = std::function<void(std::int64_t step, std::span<const model::Contact> contacts)>;
  void set_step_hook(StepHook hook) { hook_ = std::move(hook); }

 private:
  void step_frame(core::PhaseTimes& times);
  void observe();
  void end_watched_frame();

  const Communicator* comm_;
  stepping::SpaceStepper* stepper_;
  ErrorHold* errors_;
  int steps_per_frame_;
  SpaceOwnership ownership_;
  SpaceStep step_;
  stepping::Observables observables_;           ///< on root
  std::optional<stability::WorldGuard> guard_;  ///< on root
  stability::Watched now_;                  ///< on root, with a guard: what it watches, after the last frame
  std::vector<stepping::RunEvent> events_;  ///< on root
  bool is_mended_ = false;                  ///< on root
  bool is_frozen_ = false;                  ///< a guard has frozen the world
  std::int64_t steps_done_ = 0;
  SpaceRebalancer rebalancer_;  ///< used on root
  Reassignment planned_;        ///< on root: the decision of rebalancer_ after the last frame
  StepHook hook_;
  std::unique_ptr<SpaceEstimate> estimate_;  ///< with FEEC
  double estimate_s_ = 0, frame_s_ = 0;      ///< useful seconds of this rank in the last frame
};

}  // namespace pbmpi::mpi
