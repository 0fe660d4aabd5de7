/// The worlds of one rank, stepped by MuJoCo.
#pragma once

#include <map>
#include <memory>
#include <string>

#include "mujoco/world.h"
#include "stepping/stepper.h"

namespace pbmpi::mujoco {

class MujocoStepper final : public stepping::WorldStepper {
 public:
  MujocoStepper(const stepping::StepperSettings& settings, std::string warning_prefix);

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
  const stepping::StepContacts* contacts(int world) const override;

 private:
  struct Slot {
    std::shared_ptr<const model::Model> model;
    std::unique_ptr<stepping::MotorTargets> targets;
    model::State state;
    stepping::Observables observables;
    double cost_s = 0;
    std::unique_ptr<World> world;  ///< none once the state is not finite

    /// Completes a state from elsewhere, which may lack what the effect "breakable_joints" adds, and drops
    /// data that are not used here.
    void complete_state() {
      state.memory.clear();
      state.rest.clear();
      if (world) state.broken_in = world->broken_in();
    }
  };
  const Slot& get(int world) const;
  void start(Slot& slot, std::int64_t step);
  void advance_slot(int id, Slot& slot, int num_steps, core::LapTimer& timer);

  stepping::StepperSettings settings_;
  std::string warning_prefix_;
  std::map<int, Slot> slots_;
};

}  // namespace pbmpi::mujoco
