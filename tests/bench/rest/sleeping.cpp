#include "sleeping.h"

#include <algorithm>
#include <cstdio>

#include "core/clock.h"
#include "core/error.h"
#include "core/hash.h"
#include "core/statistics.h"
#include "ode/collide/narrow_phase.h"
#include "ode/objects/engine.h"
#include "ode/ode_stepper.h"
#include "scenes/scene.h"
#include "solver/worlds/sor_stepper.h"
#include "stepping/step_options.h"

namespace pbmpi::bench {
namespace {

constexpr int steps_per_frame = 3;
constexpr int num_rounds = 40;
constexpr int steps_awake = 200;  ///< before the rule begins to count
constexpr int most_steps = 6000;  ///< by then all must sleep: a minute

/// Battle2 before its action: no events, nothing moves. Standing humans sway by some 0.1 m in half a second,
/// and the rule must count this as rest.
model::Model quiet_battle2() {
  model::Model model = *scenes::parse_scene(scenes::find_scene("Battle2"))->build(0, 1);
  model.events.clear();
  for (model::Body& body : model.bodies) {
    body.velocity.setZero();
    body.angular_velocity.setZero();
  }
  model.effects["sleeping"] = true;
  model.sleep.speed = 0.4;
  model.sleep.angular_speed = 1;
  return model;
}

std::unique_ptr<stepping::WorldStepper> make_stepper(stepping::StepperKind kind) {
  const stepping::StepperSettings settings = default_settings(kind);
  if (kind == stepping::StepperKind::sor) return solver::make_sor_stepper(settings, ode::make_narrow_phase);
  return ode::make_ode_stepper(settings);
}

/// A state of Battle2 from which each frame starts.
class Side {
 public:
  Side(std::string name, stepping::StepperKind kind, const model::Model& model, const model::State& state,
       int frames_a_round)
      : name_(std::move(name)), frames_(frames_a_round), stepper_(make_stepper(kind)), start_(state) {
    stepper_->add(0, std::make_shared<const model::Model>(model), state, 0);
  }

  void time_round() {
    stepper_->set_state(0, start_, step_);
    core::PhaseTimes times;
    const double start_s = core::thread_cpu_s();
    for (int i = 0; i < frames_; ++i) stepper_->advance(steps_per_frame, times);
    frame_s_.push_back((core::thread_cpu_s() - start_s) / frames_);
    step_ += frames_ * steps_per_frame;
  }

  /// Median of the rounds' time ratios to `other`.
  void print(const Side& other) const {
    std::vector<double> ratios;
    for (std::size_t i = 0; i < frame_s_.size(); ++i) ratios.push_back(other.frame_s_[i] / frame_s_[i]);
    const auto& rest = stepper_->state(0).rest;
    const auto asleep =
        std::count_if(rest.begin(), rest.end(), [](const model::Rest& one) { return one.asleep(); });
    std::printf("  %-16s frame %9.2f us  speed x %8.1f  %3d asleep  %5d rows  deepest %5.1f mm  hash %s\n",
                name_.c_str(), 1e6 * core::quantile(frame_s_, 0.5), core::quantile(ratios, 0.5),
                static_cast<int>(asleep), stepper_->observables(0).rows,
                1e3 * stepper_->observables(0).max_penetration_m,
                core::to_hex(model::hash(stepper_->state(0))).c_str());
  }

 private:
  std::string name_;
  int frames_;  ///< per round
  std::unique_ptr<stepping::WorldStepper> stepper_;
  model::State start_;
  std::int64_t step_ = 0;
  std::vector<double> frame_s_;  ///< [num_rounds] CPU time
};

model::Model without_effects(model::Model model) {
  model.effects.clear();
  return model;
}

model::State settle(stepping::StepperKind kind, const model::Model& model) {
  core::PhaseTimes times;
  const auto restless = make_stepper(kind);
  restless->add(0, std::make_shared<const model::Model>(without_effects(model)), model::initial_state(model),
                0);
  restless->advance(steps_awake, times);
  const auto stepper = make_stepper(kind);
  stepper->add(0, std::make_shared<const model::Model>(model), restless->state(0), 0);
  for (int step = 1; step <= most_steps; ++step) {
    stepper->advance(1, times);
    const auto& rest = stepper->state(0).rest;
    if (std::all_of(rest.begin(), rest.end(), [](const model::Rest& one) { return one.asleep(); })) {
      std::printf("  all asleep after %d steps\n", steps_awake + step);
      return stepper->state(0);
    }
  }
  throw core::RunError("Battle2 does not fall asleep in a minute");
}

/// One ball that lies apart from the others rolls at walking pace.
model::State with_a_ball_awake(const model::Model& model, model::State state) {
  for (int body = 0; body < model.num_bodies(); ++body) {
    if (model.bodies[body].name != "ball_left.25") continue;
    state.velocity[body] = {0, 1, 0};
    state.rest[body] = model::begin_rest(state, body);
    return state;
  }
  throw core::RunError("Battle2 has lost its last ball");
}

void compare(const char* title, stepping::StepperKind kind) {
  std::printf("settled Battle2, %s, medians over %d alternated rounds\n", title, num_rounds);
  const model::Model model = quiet_battle2();
  const model::State asleep = settle(kind, model);
  model::State awake = asleep;
  awake.rest.clear();
  std::vector<Side> sides;
  sides.emplace_back("kept awake", kind, without_effects(model), awake, 1);
  sides.emplace_back("a ball awake", kind, model, with_a_ball_awake(model, asleep), 1);
  sides.emplace_back("all asleep", kind, model, asleep, 100);
  for (std::size_t round = 0; round < num_rounds; ++round) {
    for (std::size_t i = 0; i < sides.size(); ++i) sides[(i + round) % sides.size()].time_round();
  }
  for (const Side& side : sides) side.print(sides.front());
}

}  // namespace

void compare_sleeping() {
  const ode::Engine engine;
  compare("sor double", stepping::StepperKind::sor);
  compare("quick", stepping::StepperKind::quick);
}

}  // namespace pbmpi::bench
