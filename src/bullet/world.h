/// One world in Bullet.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bullet/collide/contacts.h"
#include "bullet/collide/island_world.h"
#include "bullet/collide/pairs.h"
#include "bullet/objects/events.h"
#include "bullet/objects/joint_loads.h"
#include "bullet/rows.h"
#include "core/clock.h"
#include "effects/step_rules.h"
#include "stepping/motor_targets.h"
#include "stepping/observables.h"
#include "stepping/stepper.h"

namespace pbmpi::bullet {

/// A world that depends only on its model, its state and the step number. effects::StepRules has the rules
/// that act around the step. Bodies that these rules put to sleep also sleep in Bullet, whose own
/// deactivation is off. A broken joint is disabled.
class World final : private effects::RuledWorld {
 public:
  /// `model`, `targets` and `collider` are borrowed; `state`: at the start of step `step`.
  World(const model::Model& model, stepping::MotorTargets& targets, const model::State& state,
        std::int64_t step, const stepping::StepperSettings& settings, Collider& collider);
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  /// Takes `num_steps` >= 1 steps. Returns false as soon as a body has a non-finite number: the world must
  /// then not be stepped again.
  [[nodiscard]] bool advance(int num_steps, core::LapTimer& timer);
  /// Puts the bodies into the state at the start of step(), the world's present step.
  void set_state(const model::State& state);
  /// Gives a motor a new target, and wakes the bodies that it drives. `target` is one of the targets.
  void aim(const stepping::MotorTargets::Target& target);
  /// Reads the state after the last step, and its observables: both are as after the last call if all bodies
  /// have slept since then.
  void read(model::State& state, stepping::Observables& observables);
  /// Contacts of the last step, with the setting `contacts`.
  const stepping::StepContacts& contacts() const { return shown_; }
  /// As in model::State.
  std::span<const model::Rest> rest() const { return state_.rest; }
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

  bool take_step(bool is_last, core::LapTimer& timer);
  void sleep_on(bool is_last);
  void collide();
  const std::vector<model::GeomPair>& awake_pairs(const std::vector<model::GeomPair>& pairs);
  void settle();
  bool is_finite() const;
  void note_centres();
  void show_contacts();

  const model::Model* model_;
  stepping::StateObserver observer_;
  stepping::MotorTargets* targets_;
  effects::StepPlan plan_;
  stepping::StepperSettings settings_;
  Bodies bodies_;
  std::vector<effects::SlowBound> slow_bounds_;  ///< [bodies]
  AxisJoints joints_;
  HeldPoses held_poses_;
  Events events_;
  model::State state_;  ///< `rest` and `broken_in` of now; poses where the rules have stored them
  effects::StepRules rules_;
  JointLoads loads_;
  btSimpleBroadphase no_pairs_;  ///< Bullet's world requires it, but never runs it
  IslandWorld world_;
  Shapes shapes_;
  Pairs pairs_;
  Contacts contacts_;
  std::vector<model::Contact> ahead_;         ///< scratch of add_speculative_contacts()
  std::vector<model::GeomPair> awake_pairs_;  ///< scratch
  std::vector<effects::BodyPair> touching_;   ///< scratch
  RowCounter row_counter_;
  stepping::Observables counts_;       ///< rows and islands of the last step
  std::vector<model::Vec3> centres_;   ///< [bodies] with `contacts`: before the last step
  stepping::StepContacts shown_;       ///< with `contacts`: those of the last step
  double linear_keep_, angular_keep_;  ///< factors that a step's damping applies to the velocities
  std::int64_t step_;
  bool moved_ = true;  ///< since the last read()
};

}  // namespace pbmpi::bullet
