/// Steps worlds whose solvers draw from different seeds.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <vector>

#include "stepping/stepper.h"

namespace pbmpi::api {

/// Keeps one stepper for each seed, shared by all worlds with that seed.
class SeededSteppers {
 public:
  using MakeStepper = std::function<std::unique_ptr<stepping::WorldStepper>(std::uint64_t seed)>;

  explicit SeededSteppers(MakeStepper make_stepper) : make_stepper_(std::move(make_stepper)) {}

  /// These do what WorldStepper's do.
  void add(int world, std::uint64_t solver_seed, std::shared_ptr<const model::Model> model,
           const model::State& state, std::int64_t step);
  void remove(int world);
  void advance(int num_steps);

  stepping::WorldStepper& of(int world) { return *seats_.at(world)->stepper; }
  const stepping::WorldStepper& of(int world) const { return *seats_.at(world)->stepper; }

 private:
  struct Seat {
    std::unique_ptr<stepping::WorldStepper> stepper;
    int num_worlds = 0;
  };

  MakeStepper make_stepper_;
  std::map<std::uint64_t, Seat> by_seed_;  ///< only seeds that have a world
  std::map<int, Seat*> seats_;             ///< by world
};

}  // namespace pbmpi::api
