#include "app/pbstudy/accuracy/reference.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "engines/stepper_factory.h"

namespace pbmpi::app {

using model::State;

/// A stepper with so many iterations, and the worlds in it.
struct ConvergingStepper::Level {
  std::unique_ptr<stepping::WorldStepper> stepper;
  std::set<int> worlds;
};

ConvergingStepper::ConvergingStepper(const Worlds& worlds, const ReferenceSolve& solve)
    : worlds_(worlds),
      solve_(solve),
      next_(worlds.size()),
      residual_(worlds.size()),
      iterations_(worlds.size()) {
  solve_.stepper.residuals = true;
  if (solve_.residual <= 0) solve_.most_iterations = solve_.stepper.iterations;  // nothing is required
  for (const auto& model : worlds_) states_.push_back(model::initial_state(*model));
}

ConvergingStepper::~ConvergingStepper() = default;

void ConvergingStepper::start_from(const std::vector<State>& states, std::int64_t step) {
  states_ = states;
  step_ = step;
}

ConvergingStepper::Level& ConvergingStepper::level(int iterations) {
  std::unique_ptr<Level>& found = levels_[iterations];
  if (!found) {
    found = std::make_unique<Level>();
    stepping::StepperSettings settings = solve_.stepper;
    settings.iterations = iterations;
    found->stepper = engines::make_stepper(settings, "reference: ");
  }
  return *found;
}

void ConvergingStepper::try_step(std::span<const int> worlds, int iterations) {
  Level& with = level(iterations);
  for (auto known = with.worlds.begin(); known != with.worlds.end();) {
    const bool stays = std::ranges::binary_search(worlds, *known);
    if (!stays) with.stepper->remove(*known);
    known = stays ? std::next(known) : with.worlds.erase(known);
  }
  for (const int world : worlds) {
    const auto place = static_cast<std::size_t>(world);
    if (with.worlds.insert(world).second) {
      with.stepper->add(world, worlds_[place], states_[place], step_);
    } else {
      with.stepper->set_state(world, states_[place], step_);
    }
  }
  core::PhaseTimes times;
  with.stepper->advance(1, times);
  const double h_s = stepping::substep_s(solve_.stepper);
  for (const int world : worlds) {
    const auto place = static_cast<std::size_t>(world);
    const stepping::Residuals& left = with.stepper->observables(world).residuals;
    next_[place] = with.stepper->state(world);
    residual_[place] = h_s * std::max(left.natural_speed, left.natural_turn);
    iterations_[place] = iterations;
  }
}

void ConvergingStepper::advance() {
  std::vector<int> open(worlds_.size());
  for (std::size_t world = 0; world < open.size(); ++world) open[world] = static_cast<int>(world);
  for (std::int64_t wanted = solve_.stepper.iterations; !open.empty(); wanted *= 4) {
    const int iterations = static_cast<int>(std::min<std::int64_t>(wanted, solve_.most_iterations));
    try_step(open, iterations);
    if (iterations == solve_.most_iterations) break;
    std::erase_if(open,
                  [&](int world) { return residual_[static_cast<std::size_t>(world)] <= solve_.residual; });
  }
  end_step();
}

void ConvergingStepper::advance_with(std::span<const int> iterations) {
  std::map<int, std::vector<int>> worlds_by_iterations;
  for (std::size_t world = 0; world < worlds_.size(); ++world)
    worlds_by_iterations[iterations[world]].push_back(static_cast<int>(world));
  for (const auto& [count, worlds] : worlds_by_iterations) try_step(worlds, count);
  end_step();
}

void ConvergingStepper::end_step() {
  std::swap(states_, next_);
  ++step_;
  for (std::size_t world = 0; world < worlds_.size(); ++world) {
    // A NaN stays: it is not a small residual.
    if (!(residual_[world] <= account_.residual)) account_.residual = residual_[world];
    account_.most_iterations = std::max(account_.most_iterations, iterations_[world]);
    account_.iterations += (iterations_[world] - account_.iterations) / static_cast<double>(++steps_done_);
  }
}

SolvedReference solve_reference(const StudyScene& scene, const ReferenceSolve& solve) {
  SolvedReference reference;
  reference.worlds = build_worlds(scene, scene.dt_s, solve.stepper.seed);
  ConvergingStepper stepper(reference.worlds, solve);
  reference.states.push_back(stepper.states());
  for (int frame = 0; frame < scene.total_frames(); ++frame) {
    for (int step = 0; step < scene.steps_per_frame(); ++step) {
      stepper.advance();
      reference.iterations.push_back(stepper.iterations());
    }
    reference.states.push_back(stepper.states());
  }
  reference.account = stepper.account();
  return reference;
}

}  // namespace pbmpi::app
