/// The worlds of one rank, stepped by ODE.
#pragma once

#include <map>
#include <memory>
#include <optional>

#include "ode/objects/engine.h"
#include "ode/solver_resources.h"
#include "ode/world.h"
#include "stepping/stepper.h"

namespace pbmpi::ode {

class OdeStepper final : public stepping::WorldStepper {
 public:
  OdeStepper(const stepping::StepperSettings& settings, WarningSink warn);
  ~OdeStepper() override;

  void add(int world, std::shared_ptr<const model::Model> model, const model::State& state,
           std::int64_t step) override;
  void remove(int world) override;
  void set_state(int world, const model::State& state, std::int64_t step) override;
  void set_motor_velocity(int world, int joint, int axis, double velocity) override;
  /// Steps the worlds one after the other, each through all its steps, so that its data stay in the cache.
  void advance(int num_steps, core::PhaseTimes& times) override;

  const model::State& state(int world) const override { return get(world).state; }
  const model::Model& model(int world) const override { return *get(world).model; }
  const stepping::Observables& observables(int world) const override { return get(world).observables; }
  double cost_s(int world) const override { return get(world).cost_s; }
  void profile_last_step() override;
  const stepping::StepProfile* profile(int world) const override;
  const stepping::StepContacts* contacts(int world) const override;

 private:
  /// The data of a world after the last advance().
  struct Slot {
    std::shared_ptr<const model::Model> model;
    std::unique_ptr<stepping::MotorTargets> targets;
    model::State state;
    stepping::Observables observables;
    double cost_s = 0;
    std::optional<stepping::StepProfile> profile;
    std::unique_ptr<World> world;  ///< none once the state is not finite: ODE would fail an assertion

    /// Completes a state from elsewhere, which may lack what the effects "sleeping" and "breakable_joints"
    /// add, and drops forces that a stepper with memory left in it.
    void complete_state() {
      state.memory.clear();
      state.rest.assign(world->rest().begin(), world->rest().end());
      state.broken_in = world->broken_in();
    }
  };
  const Slot& get(int world) const;
  void advance_slot(Slot& slot, int num_steps, core::LapTimer& timer);
  void survive(Slot& failed);
  void move_to_fresh_resources();

  Engine engine_;
  stepping::StepperSettings settings_;
  MessageLog log_;
  std::unique_ptr<SolverResources> resources_;
  std::map<int, Slot> slots_;
};

}  // namespace pbmpi::ode
