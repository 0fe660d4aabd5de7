#include "quiet.h"

#include <cmath>
#include <cstdio>

#include "core/clock.h"
#include "core/statistics.h"
#include "ode/collide/narrow_phase.h"
#include "ode/objects/engine.h"
#include "solver/worlds/sor_stepper.h"
#include "stepping/step_options.h"

namespace pbmpi::bench {
namespace {

constexpr int num_rounds = 20, frames_a_round = 5;  ///< enough for each to find its memory in the caches
constexpr int finer = 4;                            ///< factor of the reference

Models awake(const Subject& subject) {
  Models models;
  for (const auto& one : subject.models) {
    model::Model model = *one;
    model.effects["sleeping"] = false;
    models.push_back(std::make_shared<const model::Model>(std::move(model)));
  }
  return models;
}

stepping::StepperSettings settings_of(const Subject& subject) {
  stepping::StepperSettings settings = default_settings(stepping::StepperKind::sor);
  settings.dt_s = subject.dt_s;
  return settings;
}

std::vector<model::State> initial_states(const Models& models) {
  std::vector<model::State> states;
  for (const auto& model : models) states.push_back(model::initial_state(*model));
  return states;
}

class Side {
 public:
  Side(const stepping::StepperSettings& settings, const Models& models,
       const std::vector<model::State>& states, std::int64_t step)
      : stepper_(solver::make_sor_stepper(settings, ode::make_narrow_phase)),
        num_worlds_(static_cast<int>(models.size())) {
    for (std::size_t world = 0; world < models.size(); ++world)
      stepper_->add(static_cast<int>(world), models[world], states[world], step);
  }

  /// Returns seconds of CPU time.
  double advance(int num_steps) {
    core::PhaseTimes times;
    const double start_s = core::thread_cpu_s();
    stepper_->advance(num_steps, times);
    const double seconds = core::thread_cpu_s() - start_s;
    for (int world = 0; world < num_worlds_; ++world) row_visits_ += stepper_->observables(world).row_visits;
    return seconds;
  }

  std::vector<model::State> states() const {
    std::vector<model::State> states;
    for (int world = 0; world < num_worlds_; ++world) states.push_back(stepper_->state(world));
    return states;
  }

  /// Visits of rows in the last step of each call of advance().
  double row_visits() const { return row_visits_; }

 private:
  std::unique_ptr<stepping::WorldStepper> stepper_;
  int num_worlds_;
  double row_visits_ = 0;
};

/// [frames][worlds]
using Path = std::vector<std::vector<model::State>>;

double rms_m(const Path& path, const Path& reference) {
  double square_sum = 0, count = 0;
  for (std::size_t frame = 0; frame < path.size(); ++frame) {
    for (std::size_t world = 0; world < path[frame].size(); ++world) {
      const auto &here = path[frame][world].position, &there = reference[frame][world].position;
      for (std::size_t body = 0; body < here.size(); ++body)
        square_sum += (here[body] - there[body]).squaredNorm();
      count += static_cast<double>(here.size());
    }
  }
  return std::sqrt(square_sum / count);
}

}  // namespace

void compare_quiet(const Subject& subject, double from_s, double tolerance_m) {
  const ode::Engine engine;
  const Models models = awake(subject);
  const stepping::StepperSettings usual = settings_of(subject);
  Side before(usual, models, initial_states(models), 0);
  const auto from = static_cast<int>(std::lround(from_s / subject.dt_s));
  if (from > 0) before.advance(from);
  stepping::StepperSettings tolerant = usual, fine = usual;
  tolerant.tolerance_m = tolerance_m;
  for (int* number : {&fine.substeps, &fine.law.most_substeps, &fine.iterations, &fine.law.relax})
    *number *= finer;
  Side all(usual, models, before.states(), from), quiet(tolerant, models, before.states(), from),
      reference(fine, models, before.states(), from);

  std::vector<double> ratios;
  const auto advance_round = [&](Side& side, Path& path) {
    double seconds = 0;
    for (int frame = 0; frame < frames_a_round; ++frame) {
      seconds += side.advance(subject.steps_per_frame);
      path.push_back(side.states());
    }
    return seconds;
  };
  Path path_of_all, path_of_quiet, path_of_reference;
  for (int round = 0; round < num_rounds; ++round) {
    const bool all_first = round % 2 == 0;
    double all_s = 0;
    if (all_first) all_s = advance_round(all, path_of_all);
    const double quiet_s = advance_round(quiet, path_of_quiet);
    if (!all_first) all_s = advance_round(all, path_of_all);
    ratios.push_back(all_s / quiet_s);
  }
  for (int round = 0; round < num_rounds; ++round) advance_round(reference, path_of_reference);
  std::printf(
      "%s from %g s on, %d frames, tolerance %g mm: time x %.2f [%.2f, %.2f]  row visits x %.2f  "
      "defect rms %.4g mm, with the tolerance %.4g mm\n",
      subject.name.c_str(), from_s, num_rounds * frames_a_round, 1e3 * tolerance_m,
      core::quantile(ratios, 0.5), core::quantile(ratios, 0.1), core::quantile(ratios, 0.9),
      all.row_visits() / quiet.row_visits(), 1e3 * rms_m(path_of_all, path_of_reference),
      1e3 * rms_m(path_of_quiet, path_of_reference));
}

}  // namespace pbmpi::bench
