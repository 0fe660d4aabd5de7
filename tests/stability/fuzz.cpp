/// stability_fuzz [--count N] [--seed S]: steps N random worlds, from the seeds S, S + 1 ..., with quick and
/// with sor. Each must end without a crash, be finite unless a guard reported it, and, if frozen when it
/// blows up, leave the bits of the world next to it alone. A seed that fails is printed and fails the
/// program.
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>

#include "core/clock.h"
#include "core/error.h"
#include "guarded_run.h"
#include "model/validate.h"
#include "number_option.h"
#include "ode/objects/engine.h"
#include "random_model.h"
#include "scenes/scene.h"
#include "support/models.h"

namespace pbmpi::stability {
namespace {

using stepping::StepperKind;

constexpr int num_frames = 30;    ///< of 3 steps
constexpr unsigned hang_s = 300;  ///< for one world

volatile std::uint64_t seed_at_work = 0;

void on_hang(int) {
  // Only functions that a signal handler may call.
  char text[64] = "stability_fuzz: hangs with seed ";
  char digits[24];
  int count = 0;
  for (std::uint64_t rest = seed_at_work; rest > 0 || count == 0; rest /= 10)
    digits[count++] = static_cast<char>('0' + rest % 10);
  std::size_t end = std::strlen(text);
  while (count > 0) text[end++] = digits[--count];
  text[end++] = '\n';
  static_cast<void>(!write(STDERR_FILENO, text, end));
  _exit(1);
}

/// Every third world comes from a scene file.
std::shared_ptr<const model::Model> world_of(std::uint64_t seed) {
  if (seed % 3 == 0)
    return scenes::parse_scene({"random", "random.toml", random_scene(seed)})->build(0, seed);
  auto model = std::make_shared<model::Model>(random_model(seed));
  validate(*model, "random");
  return model;
}

/// The world next to the random one.
std::shared_ptr<const model::Model> neighbour() {
  static const auto model = std::make_shared<const model::Model>(support::crash());
  return model;
}

struct Tally {
  std::map<std::string, int> events;  ///< by kind
  int frozen = 0, refused = 0, ended = 0, failed = 0;
  double longest_s = 0;
};

class Trial {
 public:
  Trial(std::uint64_t seed, StepperKind kind, Tally& tally)
      : seed_(seed), settings_(random_settings(seed, kind)), model_(world_of(seed)), tally_(&tally) {}

  void run() {
    const std::uint64_t alone = neighbour_alone();
    for (const OnBlowup on_blowup : {OnBlowup::report, OnBlowup::freeze, OnBlowup::refine}) {
      try {
        run(on_blowup, alone);
      } catch (const core::RunError& error) {
        ++tally_->ended;  // an engine's own error ends a run, and is reported
        std::printf("seed %llu %s: ended: %s\n", static_cast<unsigned long long>(seed_), kind(),
                    error.what());
      }
    }
  }

 private:
  const char* kind() const { return settings_.kind == StepperKind::sor ? "sor" : "quick"; }

  std::uint64_t neighbour_alone() const {
    const auto stepper = make_any_stepper(settings_);
    stepper->add(1, neighbour(), initial_state(*neighbour()), 0);
    core::PhaseTimes times;
    for (int frame = 0; frame < num_frames; ++frame) stepper->advance(3, times);
    return model::hash(stepper->state(1));
  }

  void run(OnBlowup on_blowup, std::uint64_t alone) {
    GuardedStepper stepper(make_any_stepper(settings_), {on_blowup, settings_, make_any_stepper, {}});
    stepper.add(0, model_, initial_state(*model_), 0);
    stepper.add(1, neighbour(), initial_state(*neighbour()), 0);
    core::PhaseTimes times;
    bool told = false;
    for (int frame = 0; frame < num_frames; ++frame) {
      stepper.advance(3, times);
      bool neighbour_changed = false;
      for (const stepping::RunEvent& event : stepper.take_events()) {
        if (event.world == 0) ++tally_->events[event.kind];
        told |= event.world == 0 && event.kind == stepping::event_kind::nonfinite;
        neighbour_changed |= event.world == 1 && mends(on_blowup);
      }
      if (neighbour_changed) return;  // in some settings it blows up as well
      const bool finite = count_nonfinite(stepper.state(0)) == 0;
      expect(finite || (told && on_blowup == OnBlowup::report), "a state is not finite and was not reported");
      expect(finite == (stepper.observables(0).nonfinite == 0), "observables miss what is not finite");
    }
    tally_->frozen += stepper.state(0).guard.frozen_in >= 0 ? 1 : 0;
    expect(model::hash(stepper.state(1)) == alone, "the world beside it has other bits");
  }

  void expect(bool holds, const char* what) {
    if (holds) return;
    ++tally_->failed;
    std::printf("seed %llu %s: FAILED: %s\n", static_cast<unsigned long long>(seed_), kind(), what);
  }

  std::uint64_t seed_;
  stepping::StepperSettings settings_;
  std::shared_ptr<const model::Model> model_;
  Tally* tally_;
};

void run_seed(std::uint64_t seed, Tally& tally) {
  seed_at_work = seed;
  alarm(hang_s);
  const double start_s = core::now_s();
  try {
    for (const StepperKind kind : {StepperKind::quick, StepperKind::sor}) Trial(seed, kind, tally).run();
  } catch (const core::InputError& error) {
    ++tally.refused;  // not a world, and not a fault of a stepper
    std::printf("seed %llu: refused: %s\n", static_cast<unsigned long long>(seed), error.what());
  }
  tally.longest_s = std::max(tally.longest_s, core::now_s() - start_s);
  alarm(0);
}

int run(int argc, char** argv) {
  const auto count = static_cast<std::uint64_t>(number_option(argc, argv, "--count", 25));
  const auto first = static_cast<std::uint64_t>(number_option(argc, argv, "--seed", 1));
  const ode::Engine engine;
  std::signal(SIGALRM, on_hang);
  Tally tally;
  for (std::uint64_t seed = first; seed < first + count; ++seed) run_seed(seed, tally);
  std::printf("%llu seeds from %llu on, each with quick and sor, report, freeze and refine; longest %.1f s\n",
              static_cast<unsigned long long>(count), static_cast<unsigned long long>(first),
              tally.longest_s);
  for (const auto& [kind, times] : tally.events) std::printf("  %s %d\n", kind.c_str(), times);
  std::printf("  worlds that stand %d, runs ended by an engine's error %d, refused %d, FAILED %d\n",
              tally.frozen, tally.ended, tally.refused, tally.failed);
  return tally.failed == 0 ? 0 : 1;
}

}  // namespace
}  // namespace pbmpi::stability

int main(int argc, char** argv) { return pbmpi::stability::run(argc, argv); }
