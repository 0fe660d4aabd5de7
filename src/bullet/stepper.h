/// The worlds of one rank, stepped by Bullet.
#pragma once

#include <map>
#include <memory>
#include <string>

#include "bullet/world.h"
#include "stepping/stepper.h"

namespace pbmpi::bullet {

class BulletStepper final : public stepping::WorldStepper {
 public:
  BulletStepper(const stepping::StepperSettings& settings, std::string warning_prefix);

  void add(int world, std::shared_ptr<const model::Model> model, const model::State& state,
           std::int64_t step) override;
  void remove(int world) override;
  void set_state(int world, const model::State& state, std::int64_t step) override;
  void set_motor_velocity(int world, int joint, int axis, double velocity) override;
  /// Takes the worlds one after the other, each through all its steps.
  void advance(int num_steps, core::PhaseTimes& times) override;

  const model::State& state(int world) const override { return get(world).state; }
  const model::Model& model(int world) const override { return *get(world).model; }
  const stepping::Observables& observables(int world) const override { return get(world).observables; }
  double cost_s(int world) const override { return get(world).cost_s; }
  const stepping::StepContacts* contacts(int world) const override;

 private:
  /// The data of a world after the last advance().
  struct Slot {
    std::shared_ptr<const model::Model> model;
    std::unique_ptr<stepping::MotorTargets> targets;
    model::State state;
    stepping::Observables observables;
    double cost_s = 0;
    std::unique_ptr<World> world;  ///< none once the state is not finite

    /// Completes a state from elsewhere, which may lack what the effects "sleeping" and "breakable_joints"
    /// add, and drops forces that a stepper with memory left in it.
    void complete_state() {
      state.memory.clear();
      state.rest.assign(world->rest().begin(), world->rest().end());
      state.broken_in = world->broken_in();
    }
  };
  const Slot& get(int world) const;
  Slot& get(int world) { return const_cast<Slot&>(std::as_const(*this).get(world)); }
  void make_world(Slot& slot, std::int64_t step);
  void advance_slot(int world, Slot& slot, int num_steps, core::LapTimer& timer);

  stepping::StepperSettings settings_;
  std::string warning_prefix_;
  Collider collider_;  ///< must outlive the worlds
  std::map<int, Slot> slots_;
};

}  // namespace pbmpi::bullet
