#include "stability/finer_steps.h"

#include <utility>

namespace pbmpi::stability {

model::Model in_finer_steps(const model::Model& model, int finer) {
  model::Model scaled = model;
  for (model::Event& event : scaled.events) event.step *= finer;
  return scaled;
}

model::State to_finer_steps(model::State state, int finer) {
  for (model::Rest& rest : state.rest) {
    if (rest.asleep()) continue;
    rest.idle_steps *= finer;
    rest.watches[0].steps *= finer;
  }
  for (std::int32_t& step : state.broken_in) {
    if (step != model::unbroken) step = 0;  // long enough ago for every reader
  }
  return state;
}

model::State from_finer_steps(model::State state, int finer, const model::State& before) {
  for (model::Rest& rest : state.rest) {
    if (rest.asleep()) continue;
    rest.idle_steps /= finer;
    rest.watches[0].steps /= finer;
  }
  for (std::size_t joint = 0; joint < state.broken_in.size(); ++joint) {
    std::int32_t& step = state.broken_in[joint];
    if (step != model::unbroken) step = before.is_broken(joint) ? before.broken_in[joint] : step / finer;
  }
  return state;
}

FinerResult step_finer(const GuardSettings& settings, int world, const model::Model& model,
                       const stepping::MotorTargets& targets, const model::State& before, std::int64_t step,
                       int finer) {
  stepping::StepperSettings shorter = settings.stepper;
  shorter.dt_s /= finer;
  shorter.profile = false;
  shorter.contacts = false;
  const auto stepper = settings.make_stepper(shorter);
  add_aimed(*stepper, world, std::make_shared<const model::Model>(in_finer_steps(model, finer)), targets,
            to_finer_steps(before, finer), step * finer);
  core::PhaseTimes unused;
  stepper->advance(finer, unused);
  return {from_finer_steps(stepper->state(world), finer, before), stepper->observables(world)};
}

/// A motor with a new target wakes the bodies that it drives, which may be asleep in the state.
void add_aimed(stepping::WorldStepper& stepper, int world, std::shared_ptr<const model::Model> model,
               const stepping::MotorTargets& targets, const model::State& state, std::int64_t step) {
  stepper.add(world, std::move(model), state, step);
  if (targets.all().empty()) return;
  for (const stepping::MotorTargets::Target& target : targets.all())
    stepper.set_motor_velocity(world, target.joint, target.axis, target.motor.velocity);
  stepper.set_state(world, state, step);
}

}  // namespace pbmpi::stability
