#include "guards.h"

#include <array>
#include <cstdio>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/clock.h"
#include "core/statistics.h"
#include "ode/collide/narrow_phase.h"
#include "ode/objects/engine.h"
#include "ode/ode_stepper.h"
#include "solver/worlds/sor_stepper.h"
#include "stability/guarded_stepper.h"
#include "stepping/step_options.h"
#include "subjects.h"

namespace pbmpi::bench {
namespace {

constexpr int num_rounds = 5;
constexpr int frames_a_round = 60;

std::unique_ptr<stepping::WorldStepper> make_stepper(const stepping::StepperSettings& settings) {
  if (settings.kind == stepping::StepperKind::sor)
    return solver::make_sor_stepper(settings, ode::make_narrow_phase);
  return ode::make_ode_stepper(settings);
}

void add_worlds(const Subject& subject, stepping::WorldStepper& stepper) {
  for (std::size_t world = 0; world < subject.models.size(); ++world)
    stepper.add(static_cast<int>(world), subject.models[world], initial_state(*subject.models[world]), 0);
}

/// Forwards all calls to another stepper, and adds up the CPU time of its steps.
class Timed final : public stepping::WorldStepper {
 public:
  Timed(std::unique_ptr<stepping::WorldStepper> inner, double& seconds)
      : inner_(std::move(inner)), seconds_(&seconds) {}
  void add(int world, std::shared_ptr<const model::Model> model, const model::State& state,
           std::int64_t step) override {
    inner_->add(world, std::move(model), state, step);
  }
  void remove(int world) override { inner_->remove(world); }
  void set_state(int world, const model::State& state, std::int64_t step) override {
    inner_->set_state(world, state, step);
  }
  void advance(int num_steps, core::PhaseTimes& times) override {
    const double start_s = core::thread_cpu_s();
    inner_->advance(num_steps, times);
    *seconds_ += core::thread_cpu_s() - start_s;
  }
  const model::State& state(int world) const override { return inner_->state(world); }
  const model::Model& model(int world) const override { return inner_->model(world); }
  const stepping::Observables& observables(int world) const override { return inner_->observables(world); }
  double cost_s(int world) const override { return inner_->cost_s(world); }

 private:
  std::unique_ptr<stepping::WorldStepper> inner_;
  double* seconds_;
};

/// One ratio per frame: what the guards add to the time of the steps that they guard.
void compare(const Subject& subject, const stepping::StepperSettings& settings) {
  std::vector<double> ratios, frames_s;
  std::size_t num_events = 0;
  for (int round = 0; round < num_rounds; ++round) {
    double steps_s = 0;
    stability::GuardedStepper guarded(std::make_unique<Timed>(make_stepper(settings), steps_s),
                                      {{}, settings, make_stepper, {}});
    add_worlds(subject, guarded);
    for (int frame = 0; frame < frames_a_round; ++frame) {
      core::PhaseTimes times;
      steps_s = 0;
      const double start_s = core::thread_cpu_s();
      guarded.advance(subject.steps_per_frame, times);
      const double all_s = core::thread_cpu_s() - start_s;
      ratios.push_back(all_s / steps_s);
      frames_s.push_back(steps_s);
    }
    num_events += guarded.take_events().size();
  }
  std::printf("  %-10s %-12s frame %9.1f us  guards %+6.2f %% (quartiles %+.2f, %+.2f)  %zu events\n",
              subject.name.c_str(), stepper_text(settings).c_str(), 1e6 * core::quantile(frames_s, 0.5),
              100 * (core::quantile(ratios, 0.5) - 1), 100 * (core::quantile(ratios, 0.25) - 1),
              100 * (core::quantile(ratios, 0.75) - 1), num_events);
}

}  // namespace

void compare_guards() {
  const ode::Engine engine;
  for (const char* scene : {"CrashSk", "100CrSk", "CrashWa", "Environ", "Battle2"}) {
    const Subject subject = load_subject(scene, std::string(scene) == "100CrSk" ? 24 : 0);
    stepping::StepperSettings settings = default_settings(stepping::StepperKind::sor);
    for (const auto precision : {stepping::Precision::double_, stepping::Precision::single}) {
      settings.precision = precision;
      compare(subject, settings);
    }
    settings = {};
    compare(subject, settings);
  }
}

}  // namespace pbmpi::bench
