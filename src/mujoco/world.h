/// One world, stepped by MuJoCo.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/clock.h"
#include "effects/effects.h"
#include "effects/step_rules.h"
#include "mujoco/compiled.h"
#include "mujoco/drives.h"
#include "stepping/motor_targets.h"
#include "stepping/observables.h"
#include "stepping/step_contacts.h"
#include "stepping/stepper.h"

namespace pbmpi::mujoco {

/// Its state is the model's: MuJoCo's coordinates are computed from it anew in each step, and its solver
/// starts cold, so that a world that continues and one that is restored have the same bits.
class World final : effects::RuledWorld {
 public:
  /// `model` and `targets` are borrowed. Throws core::InputError for a world that MuJoCo refuses. Needs a
  /// MessageScope, as do set_state() and advance().
  World(const model::Model& model, stepping::MotorTargets& targets, const model::State& state,
        std::int64_t step, const stepping::StepperSettings& settings);

  void set_state(const model::State& state);
  /// Gives a motor of the world a new target.
  void aim(const stepping::MotorTargets::Target& target);
  /// Stops early if the world is lost.
  void advance(int num_steps, core::LapTimer& timer);
  void read(model::State& state, stepping::Observables& observables) const;

  /// Has it become non-finite?
  bool is_lost() const { return is_lost_; }
  const std::vector<std::int32_t>& broken_in() const { return state_.broken_in; }
  const stepping::StepContacts& contacts() const { return shown_; }
  /// The next step.
  std::int64_t step() const { return step_; }

 private:
  void fire_events(std::int64_t step) override;
  void store(std::span<const int> bodies, model::State& state) const override;
  void set_velocities(std::span<const int> bodies, const model::State& state) override;
  bool may_be_fast() const override { return false; }
  void add_speculative_contacts(effects::FastBodies&, const model::State&) override {}
  std::span<const effects::BodyPair> touching() override { return {}; }
  effects::Reaction reaction(int joint) const override { return compiled_->loads.reaction(joint); }
  bool is_driven(int) const override { return false; }  ///< asked for by sleeping alone, which is refused
  void show_awake() override {}
  void show_asleep(std::span<const int>) override {}
  /// Makes the next step use another tree.
  void show_broken() override { compiled_.reset(); }

  void compile();
  void take_step(bool is_last, core::LapTimer& timer);
  bool solve_step(int parts, bool is_last, core::LapTimer& timer);
  bool solve_parts(int parts, bool is_last, core::LapTimer& timer);
  bool solve_part(bool is_last, core::LapTimer& timer);
  void collide();
  void solve();
  void show_contacts();
  void take_in_solution();
  void lose();

  const model::Model* model_;
  stepping::StateObserver observer_;
  stepping::MotorTargets* targets_;
  effects::StepPlan plan_;
  int num_parts_;  ///< fewest MuJoCo steps in a step
  stepping::StepperSettings settings_;
  stepping::StepperSettings part_settings_;  ///< settings of one of these steps
  Drives drives_;
  model::State state_;
  model::State after_;  ///< scratch of take_step()
  effects::StepRules rules_;
  bool measures_loads_;                 ///< do joints break under load, or are forces shown?
  double kept_linear_, kept_angular_;   ///< factors that a step's damping applies to the velocities
  std::unique_ptr<Compiled> compiled_;  ///< none once different joints hold
  std::vector<mjtNum> qpos_;            ///< scratch of collide()
  stepping::Observables counts_;        ///< those of the last step
  stepping::StepContacts shown_;        ///< with `contacts`: those of the last step
  std::int64_t step_;
  bool is_lost_ = false;
};

}  // namespace pbmpi::mujoco
