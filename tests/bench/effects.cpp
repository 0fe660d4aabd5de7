#include "effects.h"

#include <cstdio>
#include <ctime>

#include "core/hash.h"
#include "core/statistics.h"
#include "effects/effects.h"
#include "ode/collide/narrow_phase.h"
#include "ode/objects/engine.h"
#include "solver/worlds/sor_stepper.h"
#include "stepping/step_options.h"
#include "support/models.h"

namespace pbmpi::bench {
namespace {

constexpr int num_worlds = 64;
constexpr int balls_a_side = 4;   ///< in each of three directions
constexpr int warmup_steps = 60;  ///< until they touch the ground and each other
constexpr int num_frames = 200;
constexpr int steps_per_frame = 3;

class Side {
 public:
  Side(std::string name, double mu, const model::EffectChoices& effects, stepping::Precision precision)
      : name_(std::move(name)) {
    stepping::StepperSettings settings = default_settings(stepping::StepperKind::sor);
    settings.precision = precision;
    stepper_ = solver::make_sor_stepper(settings, ode::make_narrow_phase);
    for (int world = 0; world < num_worlds; ++world) {
      auto model = std::make_shared<model::Model>(support::falling_balls(balls_a_side, mu, world));
      model->effects = effects;
      stepper_->add(world, model, model::initial_state(*model), 0);
    }
    steps(warmup_steps);
  }

  void time_frame() {
    const double start_s = cpu_s();
    steps(steps_per_frame);
    frame_s.push_back(cpu_s() - start_s);
    for (int world = 0; world < num_worlds; ++world) {
      num_contacts_ += stepper_->observables(world).contacts;
      deepest_m_ = std::max(deepest_m_, stepper_->observables(world).max_penetration_m);
    }
  }

  /// Median of the frames' time ratios to `other`.
  void print(const Side& other) const {
    std::vector<double> ratios;
    for (std::size_t i = 0; i < frame_s.size(); ++i) ratios.push_back(frame_s[i] / other.frame_s[i]);
    core::Hash64 hash;
    for (int world = 0; world < num_worlds; ++world) hash.add(model::hash(stepper_->state(world)));
    std::printf(
        "  %-32s frame %7.3f ms  time x %5.3f  speed x %5.2f  %5.1f contacts/world  deepest %4.1f mm  hash "
        "%s\n",
        name_.c_str(), 1e3 * core::quantile(frame_s, 0.5), core::quantile(ratios, 0.5),
        1 / core::quantile(ratios, 0.5), static_cast<double>(num_contacts_) / (num_frames * num_worlds),
        1e3 * deepest_m_, core::to_hex(hash.value()).c_str());
  }

  std::vector<double> frame_s;  ///< [num_frames] CPU time

 private:
  /// CPU seconds of this thread: where other programs share the machine, wall time says little.
  static double cpu_s() {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
  }
  void steps(int count) {
    core::PhaseTimes times;
    stepper_->advance(count, times);
  }

  std::string name_;
  std::unique_ptr<stepping::WorldStepper> stepper_;
  std::int64_t num_contacts_ = 0;
  double deepest_m_ = 0;
};

void compare(stepping::Precision precision) {
  std::vector<Side> sides;
  sides.emplace_back("with friction", 0.5, model::EffectChoices{}, precision);
  sides.emplace_back("frictionless", 0.0, model::EffectChoices{}, precision);
  sides.emplace_back("frictionless, friction demanded", 0.0, model::EffectChoices{{"friction", true}},
                     precision);
  for (std::size_t frame = 0; frame < num_frames; ++frame) {
    for (std::size_t i = 0; i < sides.size(); ++i) sides[(i + frame) % sides.size()].time_frame();
  }
  std::printf("falling spheres, sor %s: %d worlds of %d, medians over %d alternated frames\n",
              precision == stepping::Precision::single ? "single" : "double", num_worlds,
              balls_a_side * balls_a_side * balls_a_side, num_frames);
  for (const Side& side : sides) side.print(sides.front());
}

}  // namespace

void compare_effects() {
  const ode::Engine engine;
  compare(stepping::Precision::double_);
  compare(stepping::Precision::single);
}

}  // namespace pbmpi::bench
