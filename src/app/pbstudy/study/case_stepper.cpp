#include "app/pbstudy/study/case_stepper.h"

#include <cmath>
#include <utility>

#include "core/clock.h"
#include "engines/stepper_factory.h"

namespace pbmpi::app {
namespace {

using model::State;

/// `state_of(world)`: the state to compare.
template <class StateOf>
analysis::PoseErrors compare_all(const Worlds& worlds, const StateOf& state_of,
                                 const std::vector<State>& reference) {
  analysis::PoseErrors errors;
  for (std::size_t world = 0; world < worlds.size(); ++world)
    errors.append(analysis::compare(*worlds[world], view_of(state_of(world)), view_of(reference[world])));
  return errors;
}

}  // namespace

analysis::PoseView view_of(const State& state) {
  return {state.position, state.orientation, state.broken_in};
}

Worlds build_worlds(const StudyScene& scene, double dt_s, std::uint64_t seed,
                    const model::EffectChoices& effects) {
  const auto parsed = scenes::parse_scene(scene.source, dt_s, effects);
  if (dt_s == scene.dt_s) {
    Worlds worlds;
    for (int world = 0; world < scene.num_worlds; ++world) worlds.push_back(parsed->build(world, seed));
    return worlds;
  }
  const auto at_own_step = scenes::parse_scene(scene.source, scene.dt_s, effects);
  Worlds worlds;
  for (int world = 0; world < scene.num_worlds; ++world) {
    auto model = std::make_shared<model::Model>(*parsed->build(world, seed));
    model->events = at_own_step->build(world, seed)->events;
    for (model::Event& event : model->events)
      event.step = std::llround(static_cast<double>(event.step) * scene.dt_s / dt_s);
    worlds.push_back(std::move(model));
  }
  return worlds;
}

CaseStepper::CaseStepper(const Worlds& worlds, const stepping::StepperSettings& settings, int steps_per_frame,
                         const std::optional<stepping::StepperSettings>& estimate)
    : stepper_(engines::make_stepper(settings, "case: ")),
      num_worlds_(static_cast<int>(worlds.size())),
      steps_per_frame_(steps_per_frame) {
  if (estimate) estimator_ = make_estimator(*estimate);
  for (int world = 0; world < num_worlds_; ++world) {
    const auto& model = worlds[static_cast<std::size_t>(world)];
    stepper_->add(world, model, model::initial_state(*model), 0);
  }
}

void CaseStepper::start_from(const std::vector<State>& states, int frame) {
  step_ = static_cast<std::int64_t>(frame) * steps_per_frame_;
  for (int world = 0; world < num_worlds_; ++world)
    stepper_->set_state(world, states[static_cast<std::size_t>(world)], step_);
  // No frame includes the cost of a jump: joints that hold again make sor's packs anew before the next step.
  core::PhaseTimes times_of_none;
  stepper_->advance(0, times_of_none);
}

double CaseStepper::advance_frame() {
  core::PhaseTimes times;
  double estimate_s = 0;
  if (estimator_) estimate_s = estimate_frame();
  const double start_s = core::thread_cpu_s();
  stepper_->advance(steps_per_frame_, times);
  const double seconds = core::thread_cpu_s() - start_s;
  step_ += steps_per_frame_;
  return estimator_ ? estimate_s : seconds;
}

/// Seconds of processor time until the estimate is there.
double CaseStepper::estimate_frame() {
  core::PhaseTimes times;
  std::vector<stepping::LocalWorld> worlds;
  worlds.reserve(static_cast<std::size_t>(num_worlds_));
  for (int world = 0; world < num_worlds_; ++world)
    worlds.push_back({world, &stepper_->model(world), &stepper_->state(world)});
  const double start_s = core::thread_cpu_s();
  estimator_->estimate(worlds, step_, steps_per_frame_, times);
  return core::thread_cpu_s() - start_s;
}

const State& CaseStepper::shown(int world) const {
  return estimator_ ? estimator_->state(world) : stepper_->state(world);
}

stepping::Observables CaseStepper::observables(int world) const {
  stepping::Observables seen = stepper_->observables(world);
  if (!estimator_) return seen;
  stepping::observe_state(stepper_->model(world), shown(world), seen);
  return seen;
}

std::vector<State> CaseStepper::states() const {
  std::vector<State> states;
  states.reserve(static_cast<std::size_t>(num_worlds_));
  for (int world = 0; world < num_worlds_; ++world) states.push_back(stepper_->state(world));
  return states;
}

analysis::PoseErrors errors_between(const Worlds& worlds, const std::vector<State>& states,
                                    const std::vector<State>& reference) {
  return compare_all(
      worlds, [&](std::size_t world) -> const State& { return states[world]; }, reference);
}

analysis::PoseErrors errors_of(const CaseStepper& stepper, const Worlds& worlds,
                               const std::vector<State>& reference) {
  return compare_all(
      worlds, [&](std::size_t world) -> const State& { return stepper.shown(static_cast<int>(world)); },
      reference);
}

Worlds worlds_at_step(const Reference& reference, const StudyScene& scene, double dt_s, std::uint64_t seed) {
  return dt_s == scene.dt_s ? reference.worlds : build_worlds(scene, dt_s, seed);
}

Reference make_reference(const StudyScene& scene, const stepping::StepperSettings& settings) {
  Reference reference{build_worlds(scene, scene.dt_s, settings.seed), {}};
  CaseStepper stepper(reference.worlds, settings, scene.steps_per_frame());
  reference.states.push_back(stepper.states());
  for (int frame = 0; frame < scene.total_frames(); ++frame) {
    stepper.advance_frame();
    reference.states.push_back(stepper.states());
  }
  return reference;
}

}  // namespace pbmpi::app
