/// Worlds without physics, whose steps take a known time: the rest of a frame's time is the harness.
#pragma once

#include <map>
#include <memory>

#include "stepping/stepper.h"

namespace pbmpi::synthetic {

/// A world of `num_bodies` bodies, at rest and in a row.
std::shared_ptr<const model::Model> make_model(int num_bodies);

/// The state of a world at the start of a step: a function of its arguments alone, so that a lost,
/// twice-stepped or confused world shows in the hash. Orientations stay; positions and velocities are exactly
/// representable.
void put_state(int world, std::int64_t step, model::State& state);

/// The state after a call of advance() is that of put_state().
class FixedCostStepper final : public stepping::WorldStepper {
 public:
  /// A step of a world takes `step_s` of this thread's time, spent waiting on the clock; 0: none at all.
  explicit FixedCostStepper(double step_s) : step_s_(step_s) {}

  void add(int world, std::shared_ptr<const model::Model> model, const model::State& state,
           std::int64_t step) override;
  void remove(int world) override { worlds_.erase(world); }
  void set_state(int world, const model::State& state, std::int64_t step) override;
  void advance(int num_steps, core::PhaseTimes& times) override;
  const model::State& state(int world) const override { return worlds_.at(world).state; }
  const model::Model& model(int world) const override { return *worlds_.at(world).model; }
  const stepping::Observables& observables(int world) const override { return worlds_.at(world).observables; }
  double cost_s(int world) const override { return worlds_.at(world).cost_s; }

 private:
  struct World {
    std::shared_ptr<const model::Model> model;
    model::State state;
    stepping::Observables observables;
    std::int64_t step = 0;
    double cost_s = 0;
  };

  double step_s_;
  std::map<int, World> worlds_;
};

}  // namespace pbmpi::synthetic
