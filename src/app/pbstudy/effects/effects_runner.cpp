#include "app/pbstudy/effects/effects_runner.h"

#include <algorithm>
#include <array>

#include "core/statistics.h"
#include "mpi/frame/frame_driver.h"

namespace pbmpi::app {
namespace {

using model::State;

Spread spread_of(const std::vector<double>& values) {
  return {core::quantile(values, 0.5), core::quantile(values, 0.1), core::quantile(values, 0.9)};
}

/// Joins the hashes of the worlds as the state hash of a run does.
std::uint64_t hash_of(const std::vector<State>& states) {
  std::vector<std::uint64_t> hashes;
  hashes.reserve(states.size());
  for (const State& state : states) hashes.push_back(model::hash(state));
  return mpi::combine_world_hashes(hashes);
}

/// The frames of baseline or variant.
struct Side {
  CaseStepper stepper;
  std::vector<double> frame_s = {};  ///< processor time, round by round
};

/// All frames of one round, from the baseline's states, both sides in turn, beginning with side `first`. A
/// frame before them is discarded: the cost of a jump back to another step must not be timed.
template <class AfterFrame>
void run_round(std::array<Side, 2>& sides, const StudyScene& scene, const Reference& baseline,
               std::size_t first, AfterFrame&& after_frame) {
  for (Side& side : sides) {
    if (scene.warmup == 0) continue;
    side.stepper.start_from(baseline.states[static_cast<std::size_t>(scene.warmup - 1)], scene.warmup - 1);
    side.stepper.advance_frame();
  }
  for (int frame = scene.warmup; frame < scene.total_frames(); ++frame, ++first) {
    for (std::size_t i = 0; i < 2; ++i) {
      Side& side = sides[(first + i) % 2];
      side.stepper.start_from(baseline.states[static_cast<std::size_t>(frame)], frame);
      side.frame_s.push_back(side.stepper.advance_frame());
    }
    after_frame(frame);
  }
}

/// Errors after the last measured frame, and both hashes.
void measure_drift(const EffectCase& one, const StudyScene& scene, const Reference& baseline,
                   const Worlds& variant, EffectResult& result) {
  CaseStepper stepper(variant, one.stepper, scene.steps_per_frame());
  for (int frame = 0; frame < scene.total_frames(); ++frame) stepper.advance_frame();
  result.drift = analysis::summarize(errors_of(stepper, baseline.worlds, baseline.states.back()));
  result.hash_baseline = hash_of(baseline.states.back());
  result.hash_variant = hash_of(stepper.states());
}

void summarize_times(const Side& with, const Side& without, int steps_per_frame, EffectResult& result) {
  std::vector<double> with_s, without_s, cost_s, share;
  for (std::size_t i = 0; i < with.frame_s.size(); ++i) {
    with_s.push_back(with.frame_s[i] / steps_per_frame);
    without_s.push_back(without.frame_s[i] / steps_per_frame);
    cost_s.push_back(with_s.back() - without_s.back());
    share.push_back(cost_s.back() / with_s.back());
  }
  result.time_with_s = spread_of(with_s);
  result.time_without_s = spread_of(without_s);
  result.cost_s = spread_of(cost_s);
  result.share = spread_of(share);
}

}  // namespace

EffectResult run_effect_case(const EffectCase& one, const StudyScene& scene, const Reference& baseline,
                             const stepping::StepperSettings& baseline_stepper, int repeats) {
  EffectResult result;
  if (one.kind == EffectCaseKind::refused) return result;
  const Worlds variant = one.kind == EffectCaseKind::floor
                             ? baseline.worlds
                             : build_worlds(scene, scene.dt_s, baseline_stepper.seed, one.choices());
  const int steps = scene.steps_per_frame();
  std::array<Side, 2> sides = {Side{{baseline.worlds, baseline_stepper, steps}},
                               Side{{variant, one.stepper, steps}}};
  analysis::PoseErrors defect;
  for (int round = 0; round < repeats; ++round) {
    run_round(sides, scene, baseline, static_cast<std::size_t>(round), [&](int frame) {
      if (round > 0) return;  // the others give the same bits
      defect.append(
          errors_of(sides[1].stepper, baseline.worlds, baseline.states[static_cast<std::size_t>(frame) + 1]));
    });
  }
  result.defect = analysis::summarize(defect);
  const bool adds = one.kind == EffectCaseKind::demanded;
  const Side &with = sides[adds ? 1 : 0], &without = sides[adds ? 0 : 1];
  summarize_times(with, without, steps, result);
  measure_drift(one, scene, baseline, variant, result);
  return result;
}

}  // namespace pbmpi::app
