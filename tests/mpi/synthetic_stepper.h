/// A stepper without physics: bodies move by a formula of (world, body, step), and costs are set by the test.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

#include "core/random.h"
#include "stepping/stepper.h"

namespace pbmpi::testing_support {

/// World `world` has 1 + world % 3 bodies, each at a different position.
inline std::shared_ptr<const model::Model> synthetic_model(int world) {
  auto model = std::make_shared<model::Model>();
  model->actors.push_back({"prop", model::ActorKind::prop, false});
  for (int i = 0; i < 1 + world % 3; ++i) {
    model::Body body;
    body.name = "body" + std::to_string(i);
    body.pose.position = {100.0 * world, 1.0 * i, 0.5};
    body.velocity = {0.1 * world, -0.1 * i, 1.0 / 3};
    model->bodies.push_back(body);
  }
  return model;
}

class SyntheticStepper final : public stepping::WorldStepper {
 public:
  /// Behaviour that a test asks for. Each function is called with (world, the step to be done next).
  struct Behaviour {
    std::function<double(int world)> cost_s = [](int) { return 1e-3; };
    std::function<void(int world, std::int64_t step)> before_step = [](int, std::int64_t) {};  ///< may throw
    bool rests = false;      ///< does the state hold how long bodies have rested?
    int num_joints = 0;      ///< joints whose breaking step the state holds
    bool remembers = false;  ///< does a step hand on forces, in varying numbers?
    std::function<bool(int world, std::int64_t step)> turns_nan = [](int, std::int64_t) { return false; };
  };

  SyntheticStepper() = default;
  explicit SyntheticStepper(Behaviour behaviour) : behaviour_(std::move(behaviour)) {}

  void add(int world, std::shared_ptr<const model::Model> model, const model::State& state,
           std::int64_t step) override {
    const auto [added, is_new] = worlds_.emplace(world, World{std::move(model), state, {}, step});
    if (behaviour_.rests) added->second.state.rest.resize(state.position.size());
    added->second.state.broken_in.resize(static_cast<std::size_t>(behaviour_.num_joints), model::unbroken);
    if (!is_new) throw std::logic_error("world " + std::to_string(world) + " was added twice");
  }
  void remove(int world) override {
    if (worlds_.erase(world) != 1) throw std::logic_error("world " + std::to_string(world) + " is not here");
  }
  void set_state(int world, const model::State& state, std::int64_t step) override {
    worlds_.at(world).state = state;
    worlds_.at(world).step = step;
  }

  void advance(int num_steps, core::PhaseTimes& times) override {
    core::LapTimer timer(times);
    for (auto& [id, world] : worlds_) {
      for (int i = 0; i < num_steps; ++i) step(id, world);
      world.observables.nonfinite = model::count_nonfinite(world.state);
    }
    timer.lap(core::Phase::solve);
  }

  const model::State& state(int world) const override { return worlds_.at(world).state; }
  const model::Model& model(int world) const override { return *worlds_.at(world).model; }
  const stepping::Observables& observables(int world) const override { return worlds_.at(world).observables; }
  double cost_s(int world) const override { return behaviour_.cost_s(world); }

  int num_worlds() const { return static_cast<int>(worlds_.size()); }

 private:
  struct World {
    std::shared_ptr<const model::Model> model;
    model::State state;
    stepping::Observables observables;
    std::int64_t step = 0;
  };

  /// The next state depends on every number of the state and on the step's number, so a lost bit shows.
  void step(int id, World& world) {
    behaviour_.before_step(id, world.step);
    for (int i = 0; i < world.state.num_bodies(); ++i) {
      const auto key = core::mix_key(static_cast<std::uint64_t>(id), static_cast<std::uint64_t>(i),
                                     static_cast<std::uint64_t>(world.step));
      model::Vec3& velocity = world.state.velocity[i];
      velocity = 0.9 * velocity + model::Vec3(core::to_unit(key), -0.5, 0.25);
      world.state.position[i] += 0.01 * velocity;
      world.state.angular_velocity[i] += 0.5 * velocity;
      world.state.orientation[i].x = 0.5 * world.state.orientation[i].x + world.state.angular_velocity[i].x();
    }
    for (std::size_t i = 0; i < world.state.rest.size(); ++i) {
      model::Rest& rest = world.state.rest[i];
      rest.position += 0.3 * world.state.position[i];
      rest.orientation.y += world.state.position[i].z();
      rest.watches[1].tremble += rest.orientation.y;
      rest.idle_steps = static_cast<std::int32_t>(world.step % 2 == 0 ? world.step : -1 - world.step);
    }
    for (std::size_t i = 0; i < world.state.broken_in.size(); ++i) {
      if (world.step == static_cast<std::int64_t>(3 * i + 1))
        world.state.broken_in[i] = static_cast<std::int32_t>(world.step);
    }
    if (behaviour_.remembers) remember(id, world);
    if (behaviour_.turns_nan(id, world.step)) {
      world.state.position[0].x() = std::numeric_limits<double>::quiet_NaN();
    }
    ++world.step;
  }

  /// Depends on the previous memory, and has a different length in each step.
  void remember(int id, World& world) const {
    model::StepMemory& memory = world.state.memory;
    const double before = memory.contacts.empty() ? 0.1 * id : memory.contacts.front().normal;
    memory.contacts.resize(static_cast<std::size_t>((id + world.step) % 4));
    for (std::size_t i = 0; i < memory.contacts.size(); ++i) {
      const double force = 0.7 * before + static_cast<double>(i);
      memory.contacts[i] = {{0, 1}, 0, model::no_body, {force, 0, 1}, force, {0, 0.3 * force, 0}};
    }
    memory.joints.resize(static_cast<std::size_t>(behaviour_.num_joints));
    for (model::JointForce& joint : memory.joints)
      joint.torque = 0.5 * joint.torque + world.state.position[0];
  }

  Behaviour behaviour_;
  std::map<int, World> worlds_;
};

}  // namespace pbmpi::testing_support
