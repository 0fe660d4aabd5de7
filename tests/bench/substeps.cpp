#include "substeps.h"

#include <cmath>
#include <cstdio>

#include "core/clock.h"
#include "core/hash.h"
#include "core/statistics.h"
#include "model/observables.h"
#include "ode/engine.h"
#include "ode/narrow_phase.h"
#include "solver/sor_stepper.h"

namespace pbmpi::bench {
namespace {

struct Setting {
  int substeps, iterations;
  double warm_start;
};
constexpr Setting settings[] = {{1, 20, 0}, {2, 10, 0}, {4, 5, 0}, {5, 3, 0}, {5, 3, 0.3}, {5, 3, 0.9}};

class Side {
 public:
  Side(const Subject& subject, const Setting& setting, model::Precision precision)
      : subject_(&subject), setting_(setting) {
    model::StepperSettings stepper;
    stepper.kind = model::StepperKind::sor;
    stepper.dt_s = subject.dt_s;
    stepper.precision = precision;
    stepper.substeps = setting.substeps;
    stepper.iterations = setting.iterations;
    stepper.warm_start = setting.warm_start;
    stepper_ = solver::make_sor_stepper(stepper, ode::make_narrow_phase);
    for (int world = 0; world < num_worlds(); ++world) {
      const auto& model = subject.models[static_cast<std::size_t>(world)];
      stepper_->add(world, model, model::initial_state(*model), 0);
    }
  }

  void time_frame() {
    const double start_s = core::thread_cpu_s();
    stepper_->advance(subject_->steps_per_frame, times_);
    frame_s.push_back(core::thread_cpu_s() - start_s);
    for (int world = 0; world < num_worlds(); ++world) measure(world);
  }

  void print(const Side& other) const {
    std::vector<double> ratios;
    for (std::size_t i = 0; i < frame_s.size(); ++i) ratios.push_back(frame_s[i] / other.frame_s[i]);
    core::Hash64 hash;
    for (int world = 0; world < num_worlds(); ++world) hash.add(model::hash(stepper_->state(world)));
    const double num_frames = static_cast<double>(frame_s.size());
    std::printf(
        "  %d x %-2d warm %.1f  frame %6.3f ms  time x %5.3f (collide %.3f rows %.3f solve %.3f ms)  joint "
        "gap rms "
        "%6.2f mm  mean of worst %6.2f mm  deepest %4.0f mm  hash %s\n",
        setting_.substeps, setting_.iterations, setting_.warm_start, 1e3 * core::quantile(frame_s, 0.5),
        core::quantile(ratios, 0.5), 1e3 * times_[core::Phase::collide] / num_frames,
        1e3 * times_[core::Phase::rows] / num_frames, 1e3 * times_[core::Phase::solve] / num_frames,
        1e3 * std::sqrt(square_sum_ / num_gaps_), 1e3 * worst_sum_ / (num_frames * num_worlds()),
        1e3 * deepest_m_, core::to_hex(hash.value()).c_str());
  }

  std::vector<double> frame_s;  ///< [frames] of CPU time

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
    deepest_m_ = std::max(deepest_m_, stepper_->observables(world).max_penetration_m);
  }

  const Subject* subject_;
  Setting setting_;
  std::unique_ptr<model::WorldStepper> stepper_;
  core::PhaseTimes times_;
  double square_sum_ = 0, num_gaps_ = 0, worst_sum_ = 0, deepest_m_ = 0;
};

void compare(const Subject& subject, int frames, model::Precision precision) {
  std::vector<Side> sides;
  for (const Setting& setting : settings) sides.emplace_back(subject, setting, precision);
  for (int frame = 0; frame < frames; ++frame) {
    for (std::size_t i = 0; i < sides.size(); ++i)
      sides[(i + static_cast<std::size_t>(frame)) % sides.size()].time_frame();
  }
  std::printf("%s, sor %s: %zu worlds, substeps x iterations, medians over %d alternated frames\n",
              subject.name.c_str(), precision == model::Precision::single ? "single" : "double",
              subject.models.size(), frames);
  for (const Side& side : sides) side.print(sides.front());
}

}  // namespace

void compare_substeps(const Subject& subject, int frames) {
  const ode::Engine engine;
  compare(subject, frames, model::Precision::double_);
  compare(subject, frames, model::Precision::single);
}

}  // namespace pbmpi::bench
