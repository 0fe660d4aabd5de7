/// A stepper that guards its worlds.
#pragma once

#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "stability/on_blowup.h"
#include "stability/world_guard.h"
#include "stepping/motor_targets.h"
#include "stepping/run_event.h"
#include "stepping/stepper.h"

namespace pbmpi::stability {

/// Steps worlds with another stepper, and checks each of them after every advance(), which is a frame. States
/// hold the guards' memory (State::guard), so that the run continues unchanged where a world moves to another
/// rank or is restored from a checkpoint. With freeze and refine a world that blows up gets another state. A
/// frozen world is kept out of the other stepper, whose remaining worlds keep their bits.
class GuardedStepper final : public stepping::WorldStepper, public stepping::RunEventSource {
 public:
  GuardedStepper(std::unique_ptr<stepping::WorldStepper> inner, GuardSettings settings);
  GuardedStepper(const GuardedStepper&) = delete;  // the worlds' guards point to its settings
  GuardedStepper& operator=(const GuardedStepper&) = delete;

  void add(int world, std::shared_ptr<const model::Model> model, const model::State& state,
           std::int64_t step) override;
  void remove(int world) override;
  void set_state(int world, const model::State& state, std::int64_t step) override;
  /// Between frames only. In a frozen world no motor moves, but the target is kept.
  void set_motor_velocity(int world, int joint, int axis, double velocity) override;
  void advance(int num_steps, core::PhaseTimes& times) override;
  const model::State& state(int world) const override { return worlds_.at(world).now.state; }
  const model::Model& model(int world) const override { return *worlds_.at(world).model; }
  const stepping::Observables& observables(int world) const override { return worlds_.at(world).now.seen; }
  double cost_s(int world) const override;
  void profile_last_step() override { inner_->profile_last_step(); }
  const stepping::StepProfile* profile(int world) const override;
  const stepping::StepContacts* contacts(int world) const override;

  std::vector<stepping::RunEvent> take_events() override { return std::exchange(events_, {}); }

 private:
  struct Slot {
    std::shared_ptr<const model::Model> model;
    std::unique_ptr<WorldGuard> guard;
    std::int64_t step = 0;
    stepping::MotorTargets targets;
    double cost_s = 0;  ///< of the last frame
    Watched now;
  };

  void end_frame(int world, Slot& slot, int num_steps);

  GuardSettings settings_;
  std::unique_ptr<stepping::WorldStepper> inner_;
  std::map<int, Slot> worlds_;
  std::vector<stepping::RunEvent> events_;
};

}  // namespace pbmpi::stability
