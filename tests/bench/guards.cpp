#include "guards.h"

#include <array>
#include <cstdio>
#include <memory>
#include <string>
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

double time_frame(stepping::WorldStepper& stepper, int num_steps) {
  core::PhaseTimes times;
  const double start_s = core::thread_cpu_s();
  stepper.advance(num_steps, times);
  return core::thread_cpu_s() - start_s;
}

/// One ratio a frame; who goes first alternates.
void compare(const Subject& subject, const stepping::StepperSettings& settings) {
  std::vector<double> ratios, frames_s;
  std::size_t num_events = 0;
  for (int round = 0; round < num_rounds; ++round) {
    const auto bare = make_stepper(settings);
    stability::GuardedStepper guarded(make_stepper(settings), {{}, settings, make_stepper, {}});
    add_worlds(subject, *bare);
    add_worlds(subject, guarded);
    for (int frame = 0; frame < frames_a_round; ++frame) {
      double guarded_s = 0;
      if (frame % 2 == 0) guarded_s = time_frame(guarded, subject.steps_per_frame);
      const double bare_s = time_frame(*bare, subject.steps_per_frame);
      if (frame % 2 == 1) guarded_s = time_frame(guarded, subject.steps_per_frame);
      ratios.push_back(guarded_s / bare_s);
      frames_s.push_back(bare_s);
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
    stepping::StepperSettings settings;
    settings.kind = stepping::StepperKind::sor;
    for (const auto precision : {stepping::Precision::double_, stepping::Precision::single}) {
      settings.precision = precision;
      compare(subject, settings);
    }
    settings = {};
    compare(subject, settings);
  }
}

}  // namespace pbmpi::bench
