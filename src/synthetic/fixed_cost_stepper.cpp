#include "synthetic/fixed_cost_stepper.h"

#include <string>
#include <utility>

#include "core/error.h"

namespace pbmpi::synthetic {

std::shared_ptr<const model::Model> make_model(int num_bodies) {
  core::require_input(num_bodies >= 0, "a synthetic world: its number of bodies is negative");
  auto model = std::make_shared<model::Model>();
  model->actors.push_back({"synthetic", model::ActorKind::prop, false});
  for (int i = 0; i < num_bodies; ++i) {
    model::Body body;
    body.name = "body" + std::to_string(i);
    body.pose.position = {1.0 * i, 0, 0};
    model->bodies.push_back(body);
  }
  return model;
}

void put_state(int world, std::int64_t step, model::State& state) {
  for (std::size_t i = 0; i < state.position.size(); ++i) {
    state.position[i] = {static_cast<double>(i), static_cast<double>(world), static_cast<double>(step)};
    state.velocity[i] = {0, 0, 1};
  }
}

void FixedCostStepper::add(int world, std::shared_ptr<const model::Model> model, const model::State& state,
                           std::int64_t step) {
  const auto [added, is_new] = worlds_.emplace(world, World{std::move(model), state, {}, step, 0});
  core::require_invariant(is_new, "a synthetic world is added once");
}

void FixedCostStepper::set_state(int world, const model::State& state, std::int64_t step) {
  World& here = worlds_.at(world);
  here.state = state;
  here.step = step;
}

void FixedCostStepper::advance(int num_steps, core::PhaseTimes& times) {
  core::LapTimer timer(times);
  for (auto& [id, world] : worlds_) {
    world.step += num_steps;
    world.cost_s = num_steps * step_s_;
    if (step_s_ > 0) {
      const double until_s = core::now_s() + world.cost_s;
      while (core::now_s() < until_s) {
      }
    }
    if (num_steps > 0) put_state(id, world.step, world.state);
  }
  timer.lap(core::Phase::solve);
}

}  // namespace pbmpi::synthetic
