/// One world in ODE.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/clock.h"
#include "effects/effects.h"
#include "effects/fast_bodies.h"
#include "ode/collide/broad_phase.h"
#include "ode/collide/contacts.h"
#include "ode/effects/breaking.h"
#include "ode/effects/focus.h"
#include "ode/effects/sleeping.h"
#include "ode/objects/engine.h"
#include "ode/objects/events.h"
#include "ode/rows.h"
#include "ode/solver_resources.h"
#include "stepping/step_profile.h"
#include "stepping/stepper.h"

namespace pbmpi::ode {

/// A world that follows from its model, its state and the step number alone. Only the passes of the model's
/// StepPlan are there.
///
/// The collision spaces of the model cut one world over ranks; here the world is whole, and all its geoms
/// are in one ODE space.
class World {
 public:
  /// `model` is borrowed; `state`: at the start of step `step`.
  World(int id, const model::Model& model, const model::State& state, std::int64_t step,
        const stepping::StepperSettings& settings, const SolverResources& resources);
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  /// Takes `num_steps` >= 1 steps.
  void advance(int num_steps, core::LapTimer& timer, MessageLog& log);
  /// Puts the bodies into the state at the start of step(), where the world stands.
  void set_state(const model::State& state);
  /// Reads out the state after the last step, and what was observed in it.
  /// Both as they were after the last call if all bodies have slept since then.
  void read(model::State& state, stepping::Observables& observables);
  /// Measures the last step again (stepping::StepProfile); the world is then as it was, bit for bit. Needs
  /// the setting `profile` and a step taken before.
  stepping::StepProfile profile_last_step();
  /// As in model::State.
  std::span<const model::Rest> rest() const;
  const std::vector<std::int32_t>& broken_in() const { return breaking_.broken_in(); }
  /// The next step.
  std::int64_t step() const { return step_; }

 private:
  void take_step(bool is_last, core::LapTimer& timer);
  bool sleeps_on();
  void collide();
  void show_broken();
  void look_ahead();
  void solve();
  void solve_enabled(int iterations);
  void profile_collision(stepping::StepProfile& profile);
  void profile_islands(stepping::StepProfile& profile);
  double time_solve(const std::vector<dBodyID>& enabled, int iterations, const model::State& before);

  int id_;
  const model::Model* model_;
  effects::StepPlan plan_;
  stepping::StepperSettings settings_;
  WorldHandle world_;
  std::vector<dBodyID> bodies_;
  std::vector<dJointID> joints_;
  HeldPoses held_poses_;
  Events events_;
  Breaking breaking_;
  Contacts contacts_;
  std::optional<BroadPhase> broad_phase_;           ///< none without the effect "collision"
  std::optional<effects::FastBodies> fast_bodies_;  ///< none without the pass
  std::optional<Focus> focus_;                      ///< likewise; none for `direct`, which has no iterations
  model::State before_step_;                        ///< with either: at the start of the step
  std::vector<model::Contact> ahead_;               ///< contacts with a gap
  std::optional<Sleeping> sleeping_;                ///< none without the pass
  RowCounter row_counter_;
  stepping::Observables counts_;  ///< rows and islands of the last step
  model::State before_last_;      ///< with `profile`: before the last step's collision detection, events done
  std::int64_t step_;
  bool moved_ = true;  ///< since the last read()
};

}  // namespace pbmpi::ode
