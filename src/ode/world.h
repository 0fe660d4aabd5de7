/// One world in ODE.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/clock.h"
#include "effects/effects.h"
#include "effects/step_rules.h"
#include "ode/collide/broad_phase.h"
#include "ode/collide/contacts.h"
#include "ode/effects/focus.h"
#include "ode/effects/joint_loads.h"
#include "ode/objects/engine.h"
#include "ode/objects/events.h"
#include "ode/rows.h"
#include "ode/solver_resources.h"
#include "stepping/motor_targets.h"
#include "stepping/observables.h"
#include "stepping/step_profile.h"
#include "stepping/stepper.h"

namespace pbmpi::ode {

/// A world that depends only on its model, its state and the step number. It has only the passes of the
/// model's StepPlan; effects::StepRules has those that act around the step.
///
/// ODE's own auto-disable is off: bodies are disabled by State::rest. ODE enables every body that a joint,
/// contacts included, connects to an enabled one, so whole islands wake before their contacts take part in a
/// step. A broken joint is disabled and keeps its place: attached anew, it would take the pose of that moment
/// as its zero.
///
/// The collision spaces of the model cut one world over ranks; here the world is whole, and all its geoms
/// are in one ODE space.
class World final : private effects::RuledWorld {
 public:
  /// `model` and `targets` are borrowed; `state`: at the start of step `step`.
  World(int id, const model::Model& model, stepping::MotorTargets& targets, const model::State& state,
        std::int64_t step, const stepping::StepperSettings& settings, const SolverResources& resources);
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  /// Takes `num_steps` >= 1 steps.
  void advance(int num_steps, core::LapTimer& timer, MessageLog& log);
  /// Puts the bodies into the state at the start of step(), the world's present step.
  void set_state(const model::State& state);
  /// Gives a motor a new target, and wakes the bodies that it drives. `target` is one of the targets.
  void aim(const stepping::MotorTargets::Target& target);
  /// Reads the state after the last step, and its observables: both are as after the last call if all bodies
  /// have slept since then.
  void read(model::State& state, stepping::Observables& observables);
  /// Measures the last step again (stepping::StepProfile); afterwards the world is as before, bit for bit.
  /// Needs the setting `profile` and a step taken before.
  stepping::StepProfile profile_last_step();
  /// Contacts of the last step, with the setting `contacts`.
  const stepping::StepContacts& contacts() const { return shown_; }
  /// As in model::State.
  std::span<const model::Rest> rest() const;
  const std::vector<std::int32_t>& broken_in() const { return state_.broken_in; }
  /// The next step.
  std::int64_t step() const { return step_; }

 private:
  void fire_events(std::int64_t step) override;
  void store(std::span<const int> bodies, model::State& state) const override;
  void set_velocities(std::span<const int> bodies, const model::State& state) override;
  bool may_be_fast() const override;
  void add_speculative_contacts(effects::FastBodies& fast, const model::State& before) override;
  std::span<const effects::BodyPair> touching() override;
  effects::Reaction reaction(int joint) const override { return loads_.reaction(joint); }
  bool is_driven(int joint) const override { return targets_->drive(*model_, step_ + 1, joint); }
  void show_awake() override;
  void show_asleep(std::span<const int> bodies) override;
  void show_broken() override;

  void take_step(bool is_last, core::LapTimer& timer);
  void sleep_on(bool is_last);
  /// Sweeps over the rows of the island that contains this body, in the present step.
  int sweeps_of(int body) const;
  void collide();
  const std::vector<GeomPair>& awake_pairs(const std::vector<GeomPair>& pairs);
  void set_broken(const std::vector<std::int32_t>& broken_in);
  void solve();
  void solve_enabled(int iterations);
  void note_centres();
  void show_contacts();
  void profile_collision(stepping::StepProfile& profile);
  void profile_islands(stepping::StepProfile& profile);
  double time_solve(const std::vector<dBodyID>& enabled, int iterations, const model::State& before);

  int id_;
  const model::Model* model_;
  stepping::StateObserver observer_;
  stepping::MotorTargets* targets_;
  effects::StepPlan plan_;
  stepping::StepperSettings settings_;
  WorldHandle world_;
  std::vector<dBodyID> bodies_;
  std::vector<effects::SlowBound> slow_bounds_;  ///< [bodies]
  std::vector<dJointID> joints_;
  HeldPoses held_poses_;
  Events events_;
  model::State state_;  ///< `rest` and `broken_in` of now; poses where the rules have stored them
  effects::StepRules rules_;
  JointLoads loads_;
  Contacts contacts_;
  std::optional<BroadPhase> broad_phase_;    ///< none without the effect "collision"
  std::optional<Focus> focus_;               ///< none without this pass
  std::vector<model::Contact> ahead_;        ///< scratch of add_speculative_contacts()
  std::vector<GeomPair> awake_pairs_;        ///< scratch
  std::vector<effects::BodyPair> touching_;  ///< scratch
  RowCounter row_counter_;
  stepping::Observables counts_;  ///< rows and islands of the last step
  model::State before_last_;      ///< with `profile`: before the last step's collision detection, events done
  std::vector<model::Vec3> centres_;  ///< [bodies] with `contacts`: before the last step
  stepping::StepContacts shown_;      ///< with `contacts`: those of the last step
  std::int64_t step_;
  bool moved_ = true;  ///< since the last read()
};

}  // namespace pbmpi::ode
