#include "app/pbstudy/accuracy/rest_runner.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/clock.h"
#include "engines/stepper_factory.h"
#include "scenes/parts/at_rest.h"
#include "scenes/scene.h"
#include "stability/cases/case_watch.h"

namespace pbmpi::app {

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

}  // namespace pbmpi::app
