#include "substeps.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>

#include "core/clock.h"
#include "core/hash.h"
#include "model/joint_gap.h"
#include "ode/collide/narrow_phase.h"
#include "ode/objects/engine.h"
#include "solver/worlds/sor_stepper.h"
#include "stepping/step_options.h"

namespace pbmpi::bench {
namespace {

struct Setting {
  const char* name;
  stepping::Law law;
  int substeps, iterations;
  double warm_start;
};
constexpr int num_rounds = 5;
constexpr Setting settings[] = {{"1 x 20, law ode", stepping::Law::ode, 1, 20, 0},
                                {"5 x 3, law ode", stepping::Law::ode, 5, 3, 0},
                                {"1 x 1", stepping::Law::soft, 1, 1, 1},
                                {"2 x 1", stepping::Law::soft, 2, 1, 1},
                                {"4 x 1", stepping::Law::soft, 4, 1, 1},
                                {"8 x 1", stepping::Law::soft, 8, 1, 1},
                                {"14 x 1", stepping::Law::soft, 14, 1, 1},
                                {"16 x 1", stepping::Law::soft, 16, 1, 1},
                                {"14 x 1, no memory", stepping::Law::soft, 14, 1, 0}};

stepping::StepperSettings settings_of(const Setting& setting, stepping::Precision precision) {
  stepping::StepperSettings stepper = default_settings(stepping::StepperKind::sor, setting.law);
  stepper.precision = precision;
  stepper.substeps = setting.substeps;
  stepper.iterations = setting.iterations;
  stepper.law.warm_start = setting.warm_start;
  return stepper;
}

class Side {
 public:
  Side(const Subject& subject, const Setting& setting, stepping::Precision precision)
      : subject_(&subject), setting_(setting) {
    stepping::StepperSettings stepper = settings_of(setting, precision);
    stepper.dt_s = subject.dt_s;
    stepper_ = solver::make_sor_stepper(stepper, ode::make_narrow_phase);
    for (int world = 0; world < num_worlds(); ++world) {
      const auto& model = subject.models[static_cast<std::size_t>(world)];
      stepper_->add(world, model, model::initial_state(*model), 0);
    }
  }

  /// Returns seconds of CPU time.
  double advance_frame() {
    core::PhaseTimes times;
    const double start_s = core::thread_cpu_s();
    stepper_->advance(subject_->steps_per_frame, times);
    const double seconds = core::thread_cpu_s() - start_s;
    for (int world = 0; world < num_worlds(); ++world) measure(world);
    ++num_frames_;
    return seconds;
  }

  double gap_rms_m() const { return std::sqrt(square_sum_ / num_gaps_); }

  /// Ratios are to the first setting.
  void print(double frame_s, double first_frame_s, double first_gap_m) const {
    core::Hash64 hash;
    for (int world = 0; world < num_worlds(); ++world) hash.add(model::hash(stepper_->state(world)));
    std::printf(
        "  %-18s frame %6.3f ms  time x %5.3f  joint gap rms %6.2f mm  x %5.3f  "
        "mean of worst %6.2f mm  deepest contact: mean %4.1f mm, most %4.0f mm  hash %s\n",
        setting_.name, 1e3 * frame_s, frame_s / first_frame_s, 1e3 * gap_rms_m(), gap_rms_m() / first_gap_m,
        1e3 * worst_sum_ / (num_frames_ * num_worlds()), 1e3 * depth_sum_ / (num_frames_ * num_worlds()),
        1e3 * deepest_m_, core::to_hex(hash.value()).c_str());
  }

 private:
  int num_worlds() const { return static_cast<int>(subject_->models.size()); }

  void measure(int world) {
    const model::Model& model = *subject_->models[static_cast<std::size_t>(world)];
    for (const model::Joint& joint : model.joints) {
      const double gap_m = model::joint_gap(model, stepper_->state(world), joint);
      square_sum_ += gap_m * gap_m;
      ++num_gaps_;
    }
    worst_sum_ += stepper_->observables(world).joint_gap_m;
    depth_sum_ += stepper_->observables(world).max_penetration_m;
    deepest_m_ = std::max(deepest_m_, stepper_->observables(world).max_penetration_m);
  }

  const Subject* subject_;
  Setting setting_;
  std::unique_ptr<stepping::WorldStepper> stepper_;
  double square_sum_ = 0, num_gaps_ = 0, worst_sum_ = 0, depth_sum_ = 0, deepest_m_ = 0, num_frames_ = 0;
};

void compare(const Subject& subject, int frames, stepping::Precision precision) {
  const auto num_frames = static_cast<std::size_t>(frames);
  std::vector<Side> sides;
  std::vector<std::vector<double>> least_s(std::size(settings), std::vector<double>(num_frames, INFINITY));
  for (int round = 0; round < num_rounds; ++round) {
    sides.clear();
    for (const Setting& setting : settings) sides.emplace_back(subject, setting, precision);
    for (std::size_t frame = 0; frame < num_frames; ++frame) {
      for (std::size_t turn = 0; turn < sides.size(); ++turn) {
        const std::size_t i = (turn + frame) % sides.size();
        least_s[i][frame] = std::min(least_s[i][frame], sides[i].advance_frame());
      }
    }
  }
  std::printf(
      "%s, sor %s: %zu worlds, substeps x iterations; mean of %d frames, each the least of %d rounds\n",
      subject.name.c_str(), precision == stepping::Precision::single ? "single" : "double",
      subject.models.size(), frames, num_rounds);
  const auto mean = [&](const std::vector<double>& times_s) {
    return std::accumulate(times_s.begin(), times_s.end(), 0.0) / frames;
  };
  for (std::size_t i = 0; i < sides.size(); ++i)
    sides[i].print(mean(least_s[i]), mean(least_s[0]), sides[0].gap_rms_m());
}

}  // namespace

void compare_substeps(const Subject& subject, int frames) {
  const ode::Engine engine;
  compare(subject, frames, stepping::Precision::double_);
  compare(subject, frames, stepping::Precision::single);
}

}  // namespace pbmpi::bench
