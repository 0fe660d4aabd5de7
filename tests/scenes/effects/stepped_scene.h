/// World 0 of a scene, stepped.
#pragma once

#include <memory>
#include <string>

#include "../physics/every_stepper.h"
#include "effects/effects.h"
#include "scenes/scene.h"
#include "stepping/step_options.h"

namespace pbmpi::scenes {

/// A scene that comes with pbmpi, with its own time step or an nth of it, and, for quick, its own iterations.
class SteppedScene {
 public:
  explicit SteppedScene(const std::string& name, const model::EffectChoices& effects = {},
                        stepping::StepperSettings settings = default_settings(stepping::StepperKind::sor),
                        int parts = 1) {
    const auto scene = parse_scene(find_scene(name), {}, effects);
    settings.dt_s = scene->defaults().dt_s / parts;
    if (settings.kind != stepping::StepperKind::sor) settings.iterations = scene->defaults().iterations;
    dt_s_ = settings.dt_s;
    frame_s_ = scene->defaults().steps_per_frame * scene->defaults().dt_s;
    model_ = scene->build(0, 1);
    stepper_ = make_stepper(settings);
    stepper_->add(0, model_, model::initial_state(*model_), 0);
  }

  void steps(int num_steps) {
    core::PhaseTimes times;
    stepper_->advance(num_steps, times);
    time_s_ += num_steps * dt_s_;
  }
  void seconds(double duration_s) { steps(static_cast<int>(std::lround(duration_s / dt_s_))); }
  void frame() { seconds(frame_s_); }

  double dt_s() const { return dt_s_; }
  double time_s() const { return time_s_; }
  const model::Model& model() const { return *model_; }
  const model::State& state() const { return stepper_->state(0); }
  const stepping::Observables& observables() const { return stepper_->observables(0); }

  /// Why the scene calls for an effect; "" if it does not.
  std::string reason(effects::EffectId effect) const {
    const effects::StepPlan plan(*model_);
    for (const effects::Pass& pass : plan.passes()) {
      if (pass.effect->id == effect) return pass.reason.text();
    }
    return "";
  }

 private:
  std::shared_ptr<const model::Model> model_;
  std::unique_ptr<stepping::WorldStepper> stepper_;
  double dt_s_ = 0, frame_s_ = 0, time_s_ = 0;
};

}  // namespace pbmpi::scenes
