#include "app/pbstudy/study/case_stepper.h"

#include "app/common/stepper_factory.h"
#include "core/clock.h"

namespace pbmpi::app {
namespace {

using model::State;

analysis::PoseView view(const State& state) { return {state.position, state.orientation, state.broken_in}; }

}  // namespace

Worlds build_worlds(const StudyScene& scene, double dt_s, std::uint64_t seed,
                    const model::EffectChoices& effects) {
  const auto parsed = scenes::parse_scene(scene.source, dt_s, std::nullopt, effects);
  Worlds worlds;
  for (int world = 0; world < scene.num_worlds; ++world) worlds.push_back(parsed->build(world, seed));
  return worlds;
}

CaseStepper::CaseStepper(const Worlds& worlds, const stepping::StepperSettings& settings, int steps_per_frame,
                         int estimate_iterations)
    : num_worlds_(static_cast<int>(worlds.size())),
      steps_per_frame_(steps_per_frame),
      estimate_iterations_(estimate_iterations) {
  if (estimate_iterations > 0) {
    auto stepper = make_anytime_stepper(settings);
    anytime_ = stepper.get();
    stepper_ = std::move(stepper);
  } else {
    stepper_ = make_stepper(settings, "case: ");
  }
  for (int world = 0; world < num_worlds_; ++world) {
    const auto& model = worlds[static_cast<std::size_t>(world)];
    stepper_->add(world, model, model::initial_state(*model), 0);
  }
}

void CaseStepper::start_from(const std::vector<State>& states, int frame) {
  for (int world = 0; world < num_worlds_; ++world) {
    stepper_->set_state(world, states[static_cast<std::size_t>(world)],
                        static_cast<std::int64_t>(frame) * steps_per_frame_);
  }
  // What a jump costs is no frame's: joints that hold again make sor's packs anew before the next step.
  core::PhaseTimes times_of_none;
  stepper_->advance(0, times_of_none);
}

double CaseStepper::advance_frame() {
  core::PhaseTimes times;
  const double start_s = core::thread_cpu_s();
  if (anytime_ != nullptr) {
    if (steps_per_frame_ > 1) stepper_->advance(steps_per_frame_ - 1, times);
    anytime_->begin_step(estimate_iterations_, times);
  } else {
    stepper_->advance(steps_per_frame_, times);
  }
  const double seconds = core::thread_cpu_s() - start_s;
  if (anytime_ != nullptr) stepper_->advance(1, times);
  return seconds;
}

const State& CaseStepper::shown(int world) const {
  return anytime_ != nullptr ? anytime_->look(world) : stepper_->state(world);
}

stepping::Observables CaseStepper::observables(int world) const {
  stepping::Observables seen = stepper_->observables(world);
  if (anytime_ == nullptr) return seen;
  stepping::observe_state(stepper_->model(world), shown(world), seen);
  return seen;
}

std::vector<State> CaseStepper::states() const {
  std::vector<State> states;
  states.reserve(static_cast<std::size_t>(num_worlds_));
  for (int world = 0; world < num_worlds_; ++world) states.push_back(stepper_->state(world));
  return states;
}

analysis::PoseErrors errors_of(const CaseStepper& stepper, const Worlds& worlds,
                               const std::vector<State>& reference) {
  analysis::PoseErrors errors;
  for (std::size_t world = 0; world < worlds.size(); ++world) {
    errors.append(analysis::compare(*worlds[world], view(stepper.shown(static_cast<int>(world))),
                                    view(reference[world])));
  }
  return errors;
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
