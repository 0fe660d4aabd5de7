/// One world in an engine, as SlotStepper steps it.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/clock.h"
#include "effects/step_rules.h"
#include "stepping/motor_targets.h"
#include "stepping/observables.h"
#include "stepping/stepper.h"

namespace pbmpi::stepping {

/// A world that depends only on its model, its state and the step number. It has only the passes of the
/// model's StepPlan; effects::StepRules has those that act around the step.
class EngineWorld : protected effects::RuledWorld {
 public:
  virtual ~EngineWorld() = default;
  EngineWorld(const EngineWorld&) = delete;
  EngineWorld& operator=(const EngineWorld&) = delete;

  /// Takes `num_steps` >= 1 steps, fewer if the world is lost in them.
  virtual void advance(int num_steps, core::LapTimer& timer) = 0;
  /// Puts the bodies into the state at the start of step(), the world's present step.
  virtual void set_state(const model::State& state) = 0;
  /// Gives a motor a new target, and wakes the bodies that it drives. `target` is one of the targets.
  virtual void aim(const MotorTargets::Target& target) = 0;
  /// Reads the state after the last step, and its observables: both are as after the last call if all bodies
  /// have slept since then.
  virtual void read(model::State& state, Observables& observables) = 0;
  /// Measures the last step again; afterwards the world is as before, bit for bit. Needs the setting
  /// `profile` and a step taken before; nothing from an engine that does not measure.
  virtual std::optional<StepProfile> profile_last_step() { return std::nullopt; }

  /// Has it become non-finite? It must then not be stepped again.
  bool is_lost() const { return is_lost_; }
  /// Contacts of the last step, with the setting `contacts`.
  const StepContacts& contacts() const { return shown_; }
  /// As in model::State.
  const std::vector<model::Rest>& rest() const { return state_.rest; }
  const std::vector<std::int32_t>& broken_in() const { return state_.broken_in; }
  /// The next step.
  std::int64_t step() const { return step_; }

 protected:
  /// `model` and `targets` are borrowed; `state`: at the start of step `step`; `iterations`: as in
  /// effects::StepRules.
  EngineWorld(const model::Model& model, MotorTargets& targets, const model::State& state, std::int64_t step,
              const StepperSettings& settings, std::optional<int> iterations);

  /// The joints whose forces are asked for, ascending: those that can break, or all with the setting
  /// `contacts`.
  std::vector<int> measured_joints() const;

  const model::Model* model_;
  StateObserver observer_;
  MotorTargets* targets_;
  effects::StepPlan plan_;
  StepperSettings settings_;
  model::State state_;  ///< `rest` and `broken_in` of now; poses as the engine's class says
  effects::StepRules rules_;
  Observables counts_;  ///< what was counted in the last step
  StepContacts shown_;  ///< with `contacts`: those of the last step
  std::int64_t step_;
  bool is_lost_ = false;
};

}  // namespace pbmpi::stepping
