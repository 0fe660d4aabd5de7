#include "app/pbstudy/case_runner.h"

#include <algorithm>
#include <cmath>

#include "analysis/invariants.h"
#include "app/pbmpi/stepper_factory.h"
#include "core/clock.h"
#include "core/statistics.h"
#include "scenes/scene.h"

namespace pbmpi::app {
namespace {

using analysis::PoseErrors;
using model::State;

analysis::PoseView view(const State& state) { return {state.position, state.orientation}; }

/// A stepper with all worlds of a case, and the frames that it has done.
class CaseStepper {
 public:
  CaseStepper(const Worlds& worlds, const model::StepperSettings& settings, int steps_per_frame,
              int estimate_iterations = 0)
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

  void start_from(const std::vector<State>& states, int frame) {
    for (int world = 0; world < num_worlds_; ++world) {
      stepper_->set_state(world, states[static_cast<std::size_t>(world)],
                          static_cast<std::int64_t>(frame) * steps_per_frame_);
    }
  }
  /// Seconds of processor time that one frame takes; of an estimate those until it is there.
  double advance_frame() {
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
  /// As the last frame showed it: its end, or its estimate.
  const State& shown(int world) const {
    return anytime_ != nullptr ? anytime_->look(world) : stepper_->state(world);
  }
  model::Observables observables(int world) const {
    model::Observables seen = stepper_->observables(world);
    if (anytime_ == nullptr) return seen;
    seen.joint_gap_m = model::max_joint_gap(stepper_->model(world), shown(world));
    seen.energy_j = model::mechanical_energy(stepper_->model(world), shown(world));
    return seen;
  }
  const model::WorldStepper& worlds() const { return *stepper_; }
  std::vector<State> states() const {
    std::vector<State> states;
    states.reserve(static_cast<std::size_t>(num_worlds_));
    for (int world = 0; world < num_worlds_; ++world) states.push_back(stepper_->state(world));
    return states;
  }

 private:
  std::unique_ptr<model::WorldStepper> stepper_;
  model::AnytimeStepper* anytime_ = nullptr;  ///< the same, if it is to estimate
  int num_worlds_;
  int steps_per_frame_;
  int estimate_iterations_;
};

/// state_of(world) against the reference.
template <class StateOf>
PoseErrors errors_of(StateOf state_of, const Worlds& worlds, const std::vector<State>& reference) {
  PoseErrors errors;
  for (std::size_t world = 0; world < worlds.size(); ++world) {
    errors.append(
        analysis::compare(*worlds[world], view(state_of(static_cast<int>(world))), view(reference[world])));
  }
  return errors;
}

/// Raises `most` to `value`; a NaN counts as infinite.
void raise(double& most, double value) { most = std::isnan(value) ? INFINITY : std::max(most, value); }

/// What a frame did to joints, contacts, energy, momentum and segments.
void observe(const CaseStepper& stepper, const Worlds& worlds, const std::vector<State>& reference,
             CaseResult& result) {
  for (std::size_t i = 0; i < worlds.size(); ++i) {
    const auto world = static_cast<int>(i);
    const model::Observables seen = stepper.observables(world);
    const State& state = stepper.shown(world);
    result.rows += seen.rows;
    raise(result.max_joint_gap_m, seen.joint_gap_m);
    raise(result.max_penetration_m, seen.max_penetration_m);
    raise(result.energy_change_j,
          std::abs(seen.energy_j - model::mechanical_energy(*worlds[i], reference[i])));
    raise(result.momentum_change_ns,
          (analysis::linear_momentum(*worlds[i], state) - analysis::linear_momentum(*worlds[i], reference[i]))
              .norm());
    const auto segments = analysis::human_segments(*worlds[i]);
    for (const double stretch : analysis::segment_stretch(*worlds[i], segments, view(state))) {
      raise(result.max_stretch, stretch);
    }
  }
}

/// Times [measured frame][repeat], in rounds over the frames: from one frame to the next the stepper already
/// stands at the right step. Errors come from the first round, the others give the same bits.
std::vector<std::vector<double>> measure_defect(const AccuracyCase& one, const StudyScene& scene,
                                                const Reference& reference, const Worlds& worlds, int repeats,
                                                CaseResult& result) {
  CaseStepper stepper(worlds, one.stepper, one.steps_per_frame, one.estimate_iterations);
  const auto shown = [&](int world) -> const State& { return stepper.shown(world); };
  std::vector<std::vector<double>> times_s(static_cast<std::size_t>(scene.frames));
  PoseErrors errors;
  for (int round = 0; round < repeats; ++round) {
    if (scene.warmup > 0) {  // what a jump back to another step costs must not be timed
      stepper.start_from(reference.states[static_cast<std::size_t>(scene.warmup - 1)], scene.warmup - 1);
      stepper.advance_frame();
    }
    for (int i = 0; i < scene.frames; ++i) {
      const int first = scene.warmup + i;
      const auto frame = static_cast<std::size_t>(first);
      stepper.start_from(reference.states[frame], first);
      times_s[static_cast<std::size_t>(i)].push_back(stepper.advance_frame());
      if (round > 0) continue;
      errors.append(errors_of(shown, worlds, reference.states[frame + 1]));
      observe(stepper, worlds, reference.states[frame + 1], result);
    }
  }
  result.rows /= scene.frames;
  const int looked = one.estimate_iterations > 0 ? one.estimate_iterations : one.sweeps();
  result.row_visits = result.rows * (one.sweeps() * (one.steps_per_frame - 1) + looked);
  result.defect = analysis::summarize(errors);
  return times_s;
}

/// An estimate's drift is that of the precise run that it is taken from.
void measure_drift(const AccuracyCase& one, const StudyScene& scene, const Reference& reference,
                   const Worlds& worlds, CaseResult& result) {
  CaseStepper stepper(worlds, one.stepper, one.steps_per_frame);
  PoseErrors errors;
  for (int frame = 0; frame < scene.total_frames(); ++frame) {
    stepper.advance_frame();
    if (frame < scene.warmup) continue;
    errors.append(errors_of([&](int world) -> const State& { return stepper.worlds().state(world); }, worlds,
                            reference.states[static_cast<std::size_t>(frame) + 1]));
  }
  result.drift = analysis::summarize(errors);
}

void summarize_times(const std::vector<std::vector<double>>& times_s, CaseResult& result) {
  std::vector<double> medians, all;
  for (const std::vector<double>& frame : times_s) {
    medians.push_back(core::quantile(frame, 0.5));
    all.insert(all.end(), frame.begin(), frame.end());
  }
  result.frame_time_median_s = core::quantile(medians, 0.5);
  result.frame_time_worst_s = *std::max_element(medians.begin(), medians.end());
  result.frame_time_p10_s = core::quantile(all, 0.1);
  result.frame_time_p90_s = core::quantile(all, 0.9);
}

}  // namespace

Worlds build_worlds(const StudyScene& scene, double dt_s, std::uint64_t seed) {
  const auto parsed = scenes::parse_scene(scene.source, dt_s);
  Worlds worlds;
  for (int world = 0; world < scene.num_worlds; ++world) worlds.push_back(parsed->build(world, seed));
  return worlds;
}

Reference make_reference(const StudyScene& scene, const model::StepperSettings& settings) {
  Reference reference{build_worlds(scene, scene.dt_s, settings.seed), {}};
  CaseStepper stepper(reference.worlds, settings, static_cast<int>(std::round(scene.frame_s / scene.dt_s)));
  reference.states.push_back(stepper.states());
  for (int frame = 0; frame < scene.total_frames(); ++frame) {
    stepper.advance_frame();
    reference.states.push_back(stepper.states());
  }
  return reference;
}

CaseResult run_case(const AccuracyCase& one, const StudyScene& scene, const Reference& reference,
                    int repeats) {
  CaseResult result;
  // Another step length has its events at other steps. The bodies are the same.
  const bool own_step = one.stepper.dt_s == scene.dt_s;
  const Worlds worlds = own_step ? reference.worlds : build_worlds(scene, one.stepper.dt_s, one.stepper.seed);
  const bool is_yardstick = one.kind != CaseKind::setting && one.kind != CaseKind::estimate;
  const auto times_s = measure_defect(one, scene, reference, worlds, is_yardstick ? 1 : repeats, result);
  summarize_times(times_s, result);
  measure_drift(one, scene, reference, worlds, result);
  return result;
}

}  // namespace pbmpi::app
