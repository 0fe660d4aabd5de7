#include "compare.h"

#include <algorithm>
#include <cstdio>
#include <ctime>

#include "core/clock.h"
#include "core/hash.h"
#include "core/statistics.h"
#include "ode/engine.h"
#include "ode/ode_stepper.h"

namespace pbmpi::bench {
namespace {

/// Seconds that this thread has run: where other programs share the machine, wall time says little.
double cpu_s() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// Seconds of each measured frame, and what was in it.
struct Result {
  std::vector<double> frame_s;
  std::vector<double> frame_cpu_s;
  double num_contacts = 0;  ///< mean of a step over the measured frames
  std::uint64_t hash = 0;

  double world_steps_per_s(const Subject& subject) const {
    const double steps = static_cast<double>(subject.models.size()) * subject.steps_per_frame;
    return steps / core::quantile(frame_s, 0.5);
  }
};

/// pbmpi's side, as its frame loop drives it: seeds, canonical contacts, state and observables read out. The
/// recording of a frame is measured with the program itself (pbmpi --output against --no-output).
class Ours {
 public:
  explicit Ours(const Subject& subject)
      : subject_(&subject),
        stepper_(ode::make_ode_stepper({model::StepperKind::quick, subject.dt_s, subject.iterations, 1})) {
    for (int world = 0; world < num_worlds(); ++world) {
      const auto& model = subject.models[static_cast<std::size_t>(world)];
      stepper_->add(world, model, model::initial_state(*model), 0);
    }
  }
  void advance_frame() { stepper_->advance(subject_->steps_per_frame, times_); }
  int num_contacts() const {
    int sum = 0;
    for (int world = 0; world < num_worlds(); ++world) sum += stepper_->observables(world).contacts;
    return sum;
  }
  model::State state(int world) const { return stepper_->state(world); }
  int num_worlds() const { return static_cast<int>(subject_->models.size()); }

 private:
  const Subject* subject_;
  std::unique_ptr<model::WorldStepper> stepper_;
  core::PhaseTimes times_;
};

class Bare {
 public:
  explicit Bare(const Subject& subject)
      : subject_(&subject), loop_(subject.models, subject.dt_s, subject.iterations) {}
  void advance_frame() { loop_.advance(subject_->steps_per_frame); }
  int num_contacts() const { return loop_.num_contacts(); }
  model::State state(int world) const { return loop_.state(world); }
  int num_worlds() const { return static_cast<int>(subject_->models.size()); }

 private:
  const Subject* subject_;
  BareOde loop_;
};

template <class Side>
void time_frame(Side& side, Result& result) {
  const double start_s = core::now_s();
  const double start_cpu_s = cpu_s();
  side.advance_frame();
  result.frame_cpu_s.push_back(cpu_s() - start_cpu_s);
  result.frame_s.push_back(core::now_s() - start_s);
  result.num_contacts += side.num_contacts();
}

template <class Side>
std::uint64_t hash_of(const Side& side) {
  core::Hash64 hash;
  for (int world = 0; world < side.num_worlds(); ++world) hash.add(model::hash(side.state(world)));
  return hash.value();
}

void run_round(const Subject& subject, int frames, Result& ours_result, Result& bare_result) {
  Ours ours(subject);
  Bare bare(subject);
  for (int frame = 0; frame < subject.warmup; ++frame) {
    ours.advance_frame();
    bare.advance_frame();
  }
  for (int frame = 0; frame < frames; ++frame) {
    if (frame % 2 == 0) time_frame(ours, ours_result);
    time_frame(bare, bare_result);
    if (frame % 2 != 0) time_frame(ours, ours_result);
  }
  ours_result.hash = hash_of(ours);
  bare_result.hash = hash_of(bare);
}

void print(const char* name, const Subject& subject, const Result& result) {
  const double frames = static_cast<double>(result.frame_s.size());
  std::printf(
      "  %-6s %10.0f world-steps/s  frame %8.3f ms  %7.1f contacts/world  %.0f world-steps/CPU s  hash %s\n",
      name, result.world_steps_per_s(subject), 1e3 * core::quantile(result.frame_s, 0.5),
      result.num_contacts / frames / static_cast<double>(subject.models.size()),
      subject.steps_per_frame * static_cast<double>(subject.models.size()) /
          core::quantile(result.frame_cpu_s, 0.5),
      core::to_hex(result.hash).c_str());
}

void print_ratio(const char* clock, const std::vector<double>& ours, const std::vector<double>& bare) {
  std::vector<double> ratios;
  for (std::size_t i = 0; i < ours.size(); ++i) ratios.push_back(ours[i] / bare[i]);
  std::printf("  %-4s time of a frame, pbmpi / bare: median %.3f (p10 %.3f, p90 %.3f)\n", clock,
              core::quantile(ratios, 0.5), core::quantile(ratios, 0.1), core::quantile(ratios, 0.9));
}

}  // namespace

void compare(const Subject& subject, int frames, int rounds) {
  const ode::Engine engine;
  Result ours, bare;
  for (int round = 0; round < rounds; ++round) run_round(subject, frames, ours, bare);
  std::printf("%s: %zu worlds, %d bodies, dt %g s, %d iterations, %d x %d frames of %d steps\n",
              subject.name.c_str(), subject.models.size(), subject.num_bodies(), subject.dt_s,
              subject.iterations, rounds, frames, subject.steps_per_frame);
  print("pbmpi", subject, ours);
  print("bare", subject, bare);
  print_ratio("wall", ours.frame_s, bare.frame_s);
  print_ratio("CPU", ours.frame_cpu_s, bare.frame_cpu_s);
}

}  // namespace pbmpi::bench
