/// Steps the worlds of one rank, each of which is an object of an engine.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "stepping/engine/engine_world.h"
#include "stepping/stepper.h"

namespace pbmpi::stepping {

/// What the steppers of ODE, Bullet and MuJoCo have in common. Steps the worlds one after the other, each
/// through all its steps, so that its data stay in the cache. A world that becomes non-finite is no longer
/// stepped: its observables show it, and the other worlds go on.
class SlotStepper : public WorldStepper {
 public:
  void add(int world, std::shared_ptr<const model::Model> model, const model::State& state,
           std::int64_t step) final;
  void remove(int world) final;
  void set_state(int world, const model::State& state, std::int64_t step) final;
  void set_motor_velocity(int world, int joint, int axis, double velocity) final;
  void advance(int num_steps, core::PhaseTimes& times) final;

  const model::State& state(int world) const final { return get(world).state; }
  const model::Model& model(int world) const final { return *get(world).model; }
  const Observables& observables(int world) const final { return get(world).observables; }
  double cost_s(int world) const final { return get(world).cost_s; }
  const StepContacts* contacts(int world) const final;
  void profile_last_step() final;
  const StepProfile* profile(int world) const final;

 protected:
  /// The data of a world after the last advance().
  struct Slot {
    std::shared_ptr<const model::Model> model;
    std::unique_ptr<MotorTargets> targets;
    model::State state;
    Observables observables;
    double cost_s = 0;
    std::optional<StepProfile> profile;
    std::unique_ptr<EngineWorld> world;  ///< none once the state is not finite

    /// Completes a state from elsewhere, which may lack what the effects "sleeping" and "breakable_joints"
    /// add, and drops forces that a stepper with memory left in it.
    void complete_state();
  };

  /// Throws core::InputError for dt <= 0 or iterations < 1.
  explicit SlotStepper(const StepperSettings& settings);

  /// Makes the world of a slot, whose state is that at the start of step `step`; called in call_engine().
  virtual std::unique_ptr<EngineWorld> make_world(int id, const Slot& slot, std::int64_t step) = 0;
  /// Runs a call that reaches the engine, for a world before step `step`: with the engine's messages handled.
  virtual void call_engine(int world, std::int64_t step, const std::function<void()>& call);
  /// Steps a world, reads it, and ends it if it is lost; called in call_engine().
  virtual void advance_world(int id, Slot& slot, int num_steps, core::LapTimer& timer);
  /// Called before a lost world ends.
  virtual void report_loss(int world, std::int64_t step) const;
  /// To be called by the destructor of an engine's stepper that owns what its worlds use.
  void end_worlds() { slots_.clear(); }

  StepperSettings settings_;
  std::map<int, Slot> slots_;

 private:
  const Slot& get(int world) const;
  Slot& get(int world) { return const_cast<Slot&>(std::as_const(*this).get(world)); }
  void start(int id, Slot& slot, std::int64_t step);
};

/// Writes "ENGINE: world 3, step 17: this world stops here, REASON" to standard error.
void print_loss(const std::string& engine, int world, std::int64_t step, const std::string& reason);

}  // namespace pbmpi::stepping
