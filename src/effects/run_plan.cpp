#include "effects/run_plan.h"

namespace pbmpi::effects {
namespace {

std::string reason_of(const PassTally& tally, int num_worlds) {
  const int called_for = tally.worlds - tally.idle_worlds;
  if (called_for == 0) return "demanded; nothing calls for it";  // a demand holds for all worlds
  std::string text;
  for (const auto& [what, count] : tally.counts)
    text += (text.empty() ? "" : ", ") + Reason{count, what}.text();
  if (num_worlds == 1) return text;
  text += ", in " + std::to_string(called_for);
  if (called_for < num_worlds) text += " of " + std::to_string(num_worlds);
  text += " worlds";
  return tally.idle_worlds == 0 ? text : text + "; demanded in the others";
}

}  // namespace

void RunPlan::add(const model::Model& world) {
  ++num_worlds;
  const StepPlan plan(world);
  for (const Pass& pass : plan.passes()) {
    PassTally& tally = tallies[static_cast<std::size_t>(pass.effect->id)];
    ++tally.worlds;
    if (pass.idle) {
      ++tally.idle_worlds;
    } else {
      tally.counts[pass.reason.what] += pass.reason.count;
    }
  }
}

void RunPlan::add(const RunPlan& other) {
  num_worlds += other.num_worlds;
  for (std::size_t i = 0; i < tallies.size(); ++i) {
    tallies[i].worlds += other.tallies[i].worlds;
    tallies[i].idle_worlds += other.tallies[i].idle_worlds;
    for (const auto& [what, count] : other.tallies[i].counts) tallies[i].counts[what] += count;
  }
}

std::vector<RunPass> RunPlan::passes() const {
  std::vector<RunPass> passes;
  for (std::size_t i = 0; i < tallies.size(); ++i) {
    const PassTally& tally = tallies[i];
    if (tally.worlds == 0) continue;
    passes.push_back(
        {&effect_registry()[i], reason_of(tally, num_worlds), tally.idle_worlds == tally.worlds});
  }
  return passes;
}

}  // namespace pbmpi::effects
