/// Scenes stepped by ODE.
#pragma once

#include <memory>
#include <numeric>
#include <string>
#include <vector>

#include "helpers.h"
#include "ode/ode_stepper.h"
#include "stepping/stepper.h"
#include "stepping/stepper_traits.h"

namespace pbmpi::scenes {

/// All worlds of a scene, stepped with its own defaults.
class Simulation {
 public:
  explicit Simulation(const Scene& scene, int num_worlds, std::uint64_t seed = 1,
                      stepping::StepperKind kind = stepping::StepperKind::quick)
      : num_worlds_(num_worlds) {
    const RunDefaults& defaults = scene.defaults();
    steps_per_frame_ = defaults.steps_per_frame;
    stepping::StepperSettings settings = default_settings(kind);
    settings.dt_s = defaults.dt_s;
    settings.iterations = defaults.iterations;
    settings.seed = seed;
    stepper_ = ode::make_ode_stepper(settings, [](const std::string&) {});
    for (int world = 0; world < num_worlds; ++world) {
      const auto model = scene.build(world, seed);
      stepper_->add(world, model, model::initial_state(*model), 0);
    }
  }

  void steps(int num_steps) {
    core::PhaseTimes times;
    stepper_->advance(num_steps, times);
  }

  /// Islands of all worlds at the end of each frame.
  std::vector<int> islands(int num_frames) {
    std::vector<int> result;
    for (int frame = 0; frame < num_frames; ++frame) {
      steps(steps_per_frame_);
      int sum = 0;
      for (int world = 0; world < num_worlds_; ++world) sum += observables(world).islands;
      result.push_back(sum);
    }
    return result;
  }

  const model::State& state(int world) const { return stepper_->state(world); }
  const stepping::Observables& observables(int world) const { return stepper_->observables(world); }

 private:
  int num_worlds_;
  int steps_per_frame_ = 1;
  std::unique_ptr<stepping::WorldStepper> stepper_;
};

/// The islands of the measured frames, after warm-up.
inline std::vector<int> measured_islands(const std::string& name, int num_worlds, std::uint64_t seed = 1) {
  const auto scene = parse_scene(find_scene(name));
  const RunDefaults& defaults = scene->defaults();
  const auto all = Simulation(*scene, num_worlds, seed).islands(defaults.warmup + defaults.frames);
  return {all.begin() + defaults.warmup, all.end()};
}

inline double mean(const std::vector<int>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

inline int index_of(const model::Model& model, const std::string& name) {
  return static_cast<int>(&body(model, name) - model.bodies.data());
}

}  // namespace pbmpi::scenes
