/// bench_batch [WORLDS] [STEPS] [ROUNDS] [SCENE]: measures what pbmpi::Batch adds to the time of the stepper
/// under it. Both step the same worlds, alternating step by step; the output line gives the median of the
/// steps' ratios of CPU time, the seconds of a step of each, and the hash at which both end.
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include "core/clock.h"
#include "core/error.h"
#include "core/hash.h"
#include "core/statistics.h"
#include "engines/stepper_factory.h"
#include "model/state.h"
#include "mpi/frame/frame_driver.h"
#include "pbmpi/batch.h"
#include "scenes/scene.h"
#include "stepping/step_options.h"

namespace {

using namespace pbmpi;

struct Times {
  std::vector<double> batch_s, bare_s, ratio;
};

/// The worlds with the scene's and sor's defaults, in single precision.
std::unique_ptr<stepping::WorldStepper> bare_stepper(const std::string& name, int num_worlds) {
  const auto scene = scenes::parse_scene(scenes::find_scene(name));
  stepping::StepperSettings settings = default_settings(stepping::StepperKind::sor);
  settings.dt_s = scene->defaults().dt_s;
  settings.precision = stepping::Precision::single;
  auto stepper = engines::make_stepper(settings);
  std::shared_ptr<const model::Model> model;
  for (int world = 0; world < num_worlds; ++world) {
    if (!model || !scene->is_uniform()) model = scene->build(world, settings.seed);
    stepper->add(world, model, model::initial_state(*model), 0);
  }
  return stepper;
}

Batch make_batch(const std::string& scene, int num_worlds) {
  BatchOptions options;
  options.scene = scene;
  options.num_worlds = num_worlds;
  options.settings = {{"precision", "single"}};
  return Batch(options);
}

template <class Function>
double seconds_of(Function&& function) {
  const double start_s = core::thread_cpu_s();
  function();
  return core::thread_cpu_s() - start_s;
}

/// Both run from their start; the first step, which fills the lanes, is not counted.
void run_round(const std::string& scene, int num_worlds, int num_steps, Times& times) {
  const auto bare = bare_stepper(scene, num_worlds);
  Batch batch = make_batch(scene, num_worlds);
  core::PhaseTimes phases;
  bare->advance(1, phases);
  batch.step();
  for (int step = 1; step < num_steps; ++step) {
    double bare_s = 0;
    if (step % 2 == 0) bare_s = seconds_of([&] { bare->advance(1, phases); });
    times.batch_s.push_back(seconds_of([&] { batch.step(); }));
    if (step % 2 != 0) bare_s = seconds_of([&] { bare->advance(1, phases); });
    times.bare_s.push_back(bare_s);
    times.ratio.push_back(times.batch_s.back() / bare_s);
  }
  std::vector<std::uint64_t> hashes;
  for (int world = 0; world < num_worlds; ++world) hashes.push_back(model::hash(bare->state(world)));
  if (mpi::combine_world_hashes(hashes) != batch.hash())
    throw core::RunError("the batch and the bare loop have ended in other states");
}

int count(int argc, char** argv, int index, int otherwise) {
  return index < argc ? std::max(1, std::atoi(argv[index])) : otherwise;
}

}  // namespace

int main(int argc, char** argv) {
  const int num_worlds = count(argc, argv, 1, 4096), num_steps = count(argc, argv, 2, 24) + 1,
            num_rounds = count(argc, argv, 3, 3);
  const std::string scene = argc > 4 ? argv[4] : "CrashSk";
  try {
    Times times;
    for (int round = 0; round < num_rounds; ++round) run_round(scene, num_worlds, num_steps, times);
    Batch batch = make_batch(scene, num_worlds);
    batch.step(num_steps);
    std::printf(
        "%s x %d: batch over bare loop %.4f (quartiles %.4f, %.4f)  batch %.6f s a step, bare %.6f  hash "
        "%s\n",
        scene.c_str(), num_worlds, core::quantile(times.ratio, 0.5), core::quantile(times.ratio, 0.25),
        core::quantile(times.ratio, 0.75), core::quantile(times.batch_s, 0.5),
        core::quantile(times.bare_s, 0.5), core::to_hex(batch.hash()).c_str());
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_batch: %s\n", error.what());
    return 1;
  }
}
