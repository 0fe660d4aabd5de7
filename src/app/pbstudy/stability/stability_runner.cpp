#include "app/pbstudy/stability/stability_runner.h"

#include <algorithm>
#include <cmath>

#include "core/clock.h"
#include "core/error.h"
#include "engines/optional_engines.h"
#include "engines/stepper_factory.h"
#include "model/space_map.h"
#include "mpi/spaces/space_driver.h"
#include "stepping/stepper_traits.h"

namespace pbmpi::app {
namespace {

using stepping::StepperKind;

/// The most bodies for a dense solve in reasonable time: its cost is cubic in the rows.
constexpr int most_bodies_of_direct = 45;

std::string why_not(const StabilityCase& one, const HardScene& hard, double most_work) {
  if (static_cast<double>(one.num_steps) * one.num_bodies > most_work) return "left out by --most-work";
  if (one.stepper.kind == StepperKind::direct && one.num_bodies > most_bodies_of_direct)
    return "direct takes time of third order: more than " + std::to_string(most_bodies_of_direct) + " bodies";
  if (one.cut && model::make_space_map(*hard.model).num_units() < 2)
    return "joints hold all bodies together: there is nothing to cut";
  const std::vector<std::string> refused = engines::refusals(one.stepper.kind, *hard.model);
  if (!refused.empty()) return refused.front();
  return {};
}

using model::State;

/// Longer runs are observed only this often.
constexpr std::int64_t most_looks = 20'000;

/// Observes the states of a run and measures them.
class Recorder {
 public:
  Recorder(const StabilityCase& one, const HardScene& hard)
      : watch_(hard.hard_case, *hard.model, one.stepper.dt_s) {}

  void see(const State& state, const stepping::Observables& seen, std::int64_t step) {
    watch_.see(state, seen, step);
    row_visits_ += seen.row_visits;
    ++num_looks_;
  }

  void finish() {
    const stability::CaseMeasurement measured = watch_.result();
    result.metrics = measured.metrics;
    result.expected_off.fill(NAN);
    std::ranges::copy(measured.expected_off, result.expected_off.begin());
    result.broken_at_s = measured.broken_at_s;
    result.simulated_s = measured.simulated_s;
    result.row_visits = num_looks_ > 0 ? row_visits_ / static_cast<double>(num_looks_) : 0;
  }

  StabilityResult result;

 private:
  stability::CaseWatch watch_;
  std::int64_t num_looks_ = 0;
  double row_visits_ = 0;
};

void run_whole(const StabilityCase& one, const HardScene& hard, Recorder& recorder) {
  const auto stepper = engines::make_stepper(one.stepper, "case: ");
  stepper->add(0, hard.model, model::initial_state(*hard.model), 0);
  const std::int64_t stride = std::max<std::int64_t>(1, one.num_steps / most_looks);
  core::PhaseTimes times;
  double seconds = 0;
  for (std::int64_t step = 0; step < one.num_steps;) {
    const std::int64_t num_steps = std::min(stride, one.num_steps - step);
    const double start_s = core::thread_cpu_s();
    stepper->advance(static_cast<int>(num_steps), times);
    seconds += core::thread_cpu_s() - start_s;
    step += num_steps;
    recorder.see(stepper->state(0), stepper->observables(0), step);
    recorder.result.step_time_s = seconds / static_cast<double>(step);
    if (stepper->observables(0).nonfinite > 0) return;
  }
}

/// The world cut into two spaces: the first half of its units, and the rest.
std::shared_ptr<const model::Model> cut_in_two(const model::Model& whole) {
  const model::SpaceMap map = model::make_space_map(whole);
  auto cut = std::make_shared<model::Model>(whole);
  cut->spaces = {"first", "second"};
  cut->spaces_meet = true;
  for (model::Geom& geom : cut->geoms) {
    const int unit = geom.body == model::no_body ? 0 : map.unit_of_body[static_cast<std::size_t>(geom.body)];
    geom.space = 2 * unit < map.num_units() ? 0 : 1;
  }
  return cut;
}

/// Records each step of a driver.
class StepObserver final : public stepping::FrameObserver {
 public:
  explicit StepObserver(Recorder& recorder) : recorder_(recorder) {}
  void frame_done(const stepping::FrameRecord& frame) override {
    const stepping::LocalWorld& world = frame.worlds.front();
    recorder_.see(*world.state, *world.observables, frame.step);
  }

 private:
  Recorder& recorder_;
};

void run_cut(const StabilityCase& one, const HardScene& hard, Recorder& recorder) {
  const auto stepper = engines::make_space_stepper(one.stepper, cut_in_two(*hard.model));
  mpi::WorldRunSettings settings;
  settings.warmup = 0;
  settings.frames = static_cast<int>(one.num_steps);
  settings.steps_per_frame = 1;
  settings.dt_s = one.stepper.dt_s;
  mpi::SpaceDriver driver(mpi::Communicator(), *stepper, settings);  // one rank gives the result of many
  StepObserver observer(recorder);
  driver.add_observer(observer);
  const double start_s = core::thread_cpu_s();
  const mpi::WorldRunResult result = driver.run();
  recorder.result.step_time_s =
      (core::thread_cpu_s() - start_s) / static_cast<double>(std::max<std::int64_t>(1, result.frames_done));
}

}  // namespace

std::int64_t HardScene::num_steps() const { return std::llround(hard_case.seconds / dt_s); }

HardScene build_hard_scene(const StudyScene& scene, double dt_s, std::uint64_t seed) {
  const auto parsed = scenes::parse_scene(scene.source, dt_s);
  core::require_input(parsed->hard_case().has_value(),
                      "--scene " + scene.source.name +
                          ": it has no [case], so that nothing says what should happen; add one "
                          "(scenes/FORMAT.md)");
  return {parsed->build(0, seed), *parsed->hard_case(), dt_s};
}

std::vector<StabilityCase> make_stability_cases(const std::vector<StudyScene>& scenes,
                                                const StabilityOptions& options) {
  std::vector<StabilityCase> cases;
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const HardScene hard = build_hard_scene(scenes[i], scenes[i].dt_s, options.seed);
    for (std::size_t k = 0; k < options.settings.size(); ++k) {
      const StabilitySetting& setting = options.settings[k];
      StabilityCase one;
      one.scene = static_cast<int>(i);
      one.setting = static_cast<int>(k);
      one.stepper = setting.stepper;
      if (!setting.own_dt) one.stepper.dt_s = scenes[i].dt_s;
      one.stepper.seed = options.seed;
      one.cut = setting.cut;
      one.num_steps = std::llround(hard.hard_case.seconds / one.stepper.dt_s);
      one.num_bodies = hard.model->num_bodies();
      one.not_applicable = why_not(one, hard, options.most_work);
      cases.push_back(std::move(one));
    }
  }
  return cases;
}

double cost_of(const StabilityCase& one) {
  if (!one.not_applicable.empty()) return 0;
  const stepping::StepperTraits& traits = traits_of(one.stepper.kind);
  const double bodies = one.num_bodies;
  const double sweeps = sweeps_of(one.stepper);
  const double step = one.stepper.kind == StepperKind::direct ? traits.relative_cost * std::pow(bodies, 3)
                                                              : traits.relative_cost * (sweeps + 5) * bodies;
  return step * static_cast<double>(one.num_steps);
}

stability::CaseMeasurement StabilityResult::measurement(const stability::HardCase& hard_case) const {
  stability::CaseMeasurement measured;
  measured.metrics = metrics;
  measured.expected_off.assign(expected_off.begin(),
                               expected_off.begin() + std::ssize(hard_case.expectations));
  measured.broken_at_s = broken_at_s;
  measured.simulated_s = simulated_s;
  return measured;
}

StabilityResult run_stability_case(const StabilityCase& one, const HardScene& hard) {
  core::require_input(hard.hard_case.expectations.size() <= most_expectations,
                      "[[case.expect]]: at most " + std::to_string(most_expectations) + " of a case");
  Recorder recorder(one, hard);
  if (!one.not_applicable.empty()) return recorder.result;
  if (one.cut) {
    run_cut(one, hard, recorder);
  } else {
    run_whole(one, hard, recorder);
  }
  recorder.finish();
  return recorder.result;
}

}  // namespace pbmpi::app
