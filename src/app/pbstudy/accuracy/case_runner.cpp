#include "app/pbstudy/accuracy/case_runner.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/clock.h"
#include "core/statistics.h"
#include "engines/stepper_factory.h"
#include "model/mechanics.h"
#include "scenes/parts/at_rest.h"
#include "scenes/scene.h"
#include "stability/cases/case_watch.h"

namespace pbmpi::app {
namespace {

using analysis::PoseErrors;
using model::State;

/// Raises `most` to `value`; a NaN counts as infinite.
void raise(double& most, double value) { most = std::isnan(value) ? INFINITY : std::max(most, value); }

/// Records what a frame did to joints, contacts and energy.
void observe(const CaseStepper& stepper, const Worlds& worlds, const States& nature, CaseResult& result) {
  for (std::size_t i = 0; i < worlds.size(); ++i) {
    const auto world = static_cast<int>(i);
    const stepping::Observables seen = stepper.observables(world);
    result.rows += seen.rows;
    result.row_visits += seen.row_visits;
    raise(result.max_joint_gap_m, seen.joint_gap_m);
    raise(result.max_penetration_m, seen.max_penetration_m);
    const double wanted_j = model::MechanicsMeter(*worlds[i]).measure(nature[i]).energy_j;
    raise(result.energy_change_j, std::abs(seen.energy_j - wanted_j));
  }
}

/// Times [measured frame][repeat]. Rounds go over all frames, so that the stepper already stands at the right
/// step of the next frame. Errors come from the first round; the others give the same bits.
std::vector<std::vector<double>> measure_defect(const AccuracyCase& one, const StudyScene& scene,
                                                const Nature& nature, const Worlds& worlds, int repeats,
                                                const FrameEnds* own, CaseResult& result) {
  CaseStepper stepper(worlds, one.stepper, one.steps_per_frame, one.estimate);
  std::vector<std::vector<double>> times_s(static_cast<std::size_t>(scene.frames));
  DefectOf defect(nature);
  PoseErrors own_errors;
  for (int round = 0; round < repeats; ++round) {
    if (scene.warmup > 0) {  // the cost of a jump back to another step must not be timed
      stepper.start_from(nature.states[static_cast<std::size_t>(scene.warmup - 1)], scene.warmup - 1);
      stepper.advance_frame();
    }
    for (int i = 0; i < scene.frames; ++i) {
      const int first = scene.warmup + i;
      const auto frame = static_cast<std::size_t>(first);
      stepper.start_from(nature.states[frame], first);
      times_s[static_cast<std::size_t>(i)].push_back(stepper.advance_frame());
      if (round > 0) continue;
      defect.add(
          worlds, [&](int world) -> const State& { return stepper.shown(world); },
          static_cast<std::size_t>(i));
      if (own != nullptr) own_errors.append(errors_of(stepper, worlds, (*own)[static_cast<std::size_t>(i)]));
      observe(stepper, worlds, nature.states[frame + 1], result);
    }
  }
  result.rows /= scene.frames;
  if (one.estimate) {
    result.row_visits = result.rows * one.sweeps_a_frame();
  } else {
    result.row_visits = result.row_visits * one.steps_per_frame / scene.frames;
  }
  defect.put_into(result);
  result.own_defect = analysis::summarize(own_errors);
  return times_s;
}

}  // namespace

constexpr double never = std::numeric_limits<double>::infinity();

RestRunner::RestRunner(const StudyScene& scene, const stepping::StepperSettings& reference, double seconds)
    : scene_(scene), seconds_(seconds) {
  if (seconds_ > 0) reference_sank_at_s_ = run_scene(reference).sank_at_s;
}

RestRunner::Run RestRunner::run_scene(const stepping::StepperSettings& settings) const {
  const auto model = std::make_shared<model::Model>(
      *scenes::parse_scene(scene_.source, settings.dt_s)->build(0, settings.seed));
  scenes::bring_to_rest(*model);
  stability::HardCase at_rest;
  at_rest.seconds = seconds_;
  stability::CaseWatch watch(at_rest, *model, settings.dt_s);
  const auto stepper = engines::make_stepper(settings, "at rest: ");
  const model::State start = model::initial_state(*model);
  stepper->add(0, model, start, 0);
  Run run;
  run.sank_at_s.assign(model->bodies.size(), never);
  core::PhaseTimes times;
  const std::int64_t num_steps = std::llround(seconds_ / settings.dt_s);
  for (std::int64_t step = 1; step <= num_steps; ++step) {
    stepper->advance(1, times);
    const model::State& state = stepper->state(0);
    watch.see(state, stepper->observables(0), step);
    for (std::size_t body = 0; body < run.sank_at_s.size(); ++body) {
      const bool stands = state.position[body].z() > start.position[body].z() - fall_m;  // false for a NaN
      if (!stands)
        run.sank_at_s[body] = std::min(run.sank_at_s[body], static_cast<double>(step) * settings.dt_s);
    }
    if (stepper->observables(0).nonfinite > 0) break;
  }
  run.creep_m_s = watch.metric(stability::Metric::creep);
  run.energy_gain_j = watch.metric(stability::Metric::energy_gain);
  return run;
}

RestResult RestRunner::run(const stepping::StepperSettings& settings) const {
  if (seconds_ <= 0) return {NAN, NAN, NAN, NAN};
  const Run run = run_scene(settings);
  RestResult result{0, never, run.creep_m_s, run.energy_gain_j};
  for (std::size_t body = 0; body < run.sank_at_s.size(); ++body) {
    if (run.sank_at_s[body] == never || reference_sank_at_s_[body] < never) continue;
    ++result.fallen;
    result.fell_at_s = std::min(result.fell_at_s, run.sank_at_s[body]);
  }
  return result;
}

void DefectOf::add(const Worlds& worlds, const std::function<const State&(int world)>& end, std::size_t i) {
  const States& wanted = nature_.end(i);
  for (std::size_t world = 0; world < worlds.size(); ++world)
    add_errors(
        world, i,
        analysis::compare(*worlds[world], view_of(end(static_cast<int>(world))), view_of(wanted[world])));
}

void DefectOf::add_errors(std::size_t world, std::size_t i, PoseErrors errors) {
  const PoseErrors& uncertainty = nature_.frames[i].uncertainty[world];
  counts_.count(uncertainty, errors);
  keep_judged(*nature_.worlds[world], uncertainty, errors);
  errors_.append(errors);
}

void DefectOf::put_into(CaseResult& result) const {
  result.defect = analysis::summarize(errors_);
  result.determined = counts_.determined_shares();
  result.within = counts_.within_shares();
}

CaseResult run_case(const AccuracyCase& one, const StudyScene& scene, const Nature& nature,
                    const RestRunner& rest, int repeats, const FrameEnds* own) {
  CaseResult result;
  const Worlds worlds = worlds_at_step(nature, scene, one.stepper.dt_s, one.stepper.seed);
  const auto times_s = measure_defect(one, scene, nature, worlds, repeats, own, result);
  summarize_times(times_s, result);
  // An estimate's drift is that of the precise run that it is taken from.
  CaseStepper stepper(worlds, one.stepper, one.steps_per_frame);
  PoseErrors drift;
  for (int frame = 0; frame < scene.total_frames(); ++frame) {
    stepper.advance_frame();
    if (frame >= scene.warmup)
      drift.append(errors_of(stepper, worlds, nature.states[static_cast<std::size_t>(frame) + 1]));
  }
  result.drift = analysis::summarize(drift);
  result.rest = one.kind == CaseKind::setting ? rest.run(one.stepper) : RestResult{NAN, NAN, NAN, NAN};
  return result;
}

CaseResult account_of(const Nature& nature) {
  CaseResult result = unobserved();
  DefectOf defect(nature);
  std::vector<std::vector<double>> times_s;
  for (std::size_t i = 0; i < nature.frames.size(); ++i) {
    times_s.push_back({nature.frames[i].cpu_s});
    for (std::size_t world = 0; world < nature.worlds.size(); ++world)
      defect.add_errors(world, i, nature.frames[i].uncertainty[world]);
  }
  defect.put_into(result);
  result.within.fill(NAN);
  summarize_times(times_s, result);
  return result;
}

CaseResult unobserved() {
  CaseResult result;
  for (double CaseResult::*number : {&CaseResult::rows, &CaseResult::row_visits, &CaseResult::max_joint_gap_m,
                                     &CaseResult::max_penetration_m, &CaseResult::energy_change_j})
    result.*number = NAN;
  result.rest = {NAN, NAN, NAN, NAN};
  result.within.fill(NAN);
  return result;
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

}  // namespace pbmpi::app
