#include "app/pbreport/scaling/scaling_run.h"

#include <algorithm>
#include <cstdlib>
#include <numeric>

#include "app/pbreport/run/summary_from_file.h"
#include "app/pbreport/suite/characterise.h"
#include "core/error.h"
#include "core/text.h"
#include "io/extract/run_settings.h"

namespace pbmpi::app {
namespace {

using core::value_in;

std::string problem_of(const io::RunData& run) {
  std::string text = "frames = " + value_in(run.parameters, "frames") + "\n";
  for (const auto& [name, value] : run.parameters) {
    const bool decides = io::matters_for(name) != io::Matters::nothing;
    if (decides && name != "replicas") text += name + " = " + value + "\n";
  }
  return text;
}

std::string program_of(const io::RunData& run) {
  const std::string threads = value_in(run.parameters, "threads");  // none in older files
  return value_in(run.attributes, "pbmpi_version") + ", revision " +
         value_in(run.attributes, "git_revision") + ", " + value_in(run.parameters, "build") + ", " +
         value_in(run.parameters, "simd") +
         (threads.empty() || threads == "1" ? "" : ", " + threads + " threads a rank");
}

int most_ranks_of_a_host(const std::vector<std::string>& hosts) {
  std::map<std::string, int> ranks;
  for (const std::string& host : hosts) ++ranks[host];
  int most = 0;
  for (const auto& [host, count] : ranks) most = std::max(most, count);
  return most;
}

/// Sums `of`, a number of a frame's phases [ranks], over the frames.
template <class Of>
std::vector<double> seconds_of_ranks(const MeasuredFrames& frames, const Of& of) {
  std::vector<double> seconds;
  for (const auto& rank : frames.phases) {
    double total = 0;
    for (const auto& frame : rank) total += of(core::PhaseTimes{frame});
    seconds.push_back(total);
  }
  return seconds;
}

double total(const std::vector<double>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

void take_times(const MeasuredFrames& measured, const RunSummary& summary, ScalingRun& run) {
  const auto frames = static_cast<double>(summary.measured_frames);
  run.frame_s = 1 / summary.harmonic_mean_hz;
  const auto useful_s =
      seconds_of_ranks(measured, [](const core::PhaseTimes& times) { return times.useful_s(); });
  const auto exchange_s = seconds_of_ranks(measured, [](const core::PhaseTimes& times) {
    return times[core::Phase::ship] + times[core::Phase::gather];
  });
  run.pop = efficiencies_of(useful_s, exchange_s, frames * run.frame_s);
  run.useful_s = total(useful_s) / frames;
  run.messages = total(measured.messages) / frames;
  run.bytes = total(measured.bytes) / frames;
  for (const PhaseSummary& phase : summary.phases) run.phase_s[phase.name] = phase.avg_s / frames;
}

}  // namespace

PopEfficiencies efficiencies_of(const std::vector<double>& useful_s, const std::vector<double>& exchange_s,
                                double elapsed_s) {
  const double most = *std::ranges::max_element(useful_s);
  if (!(most > 0) || !(elapsed_s > 0)) return {};
  PopEfficiencies found;
  found.load_balance = total(useful_s) / static_cast<double>(useful_s.size()) / most;
  const double ideal_s = std::max(most, elapsed_s - *std::ranges::min_element(exchange_s));
  found.transfer = std::min(1.0, ideal_s / elapsed_s);
  found.serialisation = most / ideal_s;
  return found;
}

ScalingRun read_scaling_run(const std::string& path) {
  const io::RunData data = io::read_run(path);
  const RunSummary summary = summary_from_file(data, path);
  core::require_input(summary.measured_frames > 0 && summary.harmonic_mean_hz > 0,
                      path + ": it has no measured frame; leave it out, or run longer than the warm-up");
  ScalingRun run;
  run.path = path;
  run.attributes = data.attributes;
  run.created = value_in(data.attributes, "created");
  run.scene = summary.scene;
  run.stepper = summary.stepper;
  run.precision = summary.precision;
  run.decomposition = summary.decomposition;
  run.problem = problem_of(data);
  run.program = program_of(data);
  run.state_hash = summary.state_hash;
  run.complete = summary.complete;
  run.records_islands = value_in(data.parameters, "record_islands") == "1";
  run.ranks = summary.ranks;
  run.worlds = summary.worlds;
  run.steps_per_frame = summary.steps_per_frame;
  run.most_ranks_of_a_host = most_ranks_of_a_host(data.hosts);
  run.processors = std::atoi(value_in(data.parameters, "processors").c_str());  // older files have none
  run.frames = summary.measured_frames;
  run.budget_s = summary.budget_s;
  run.within_budget = summary.satisfied_fraction;
  if (run.decomposition == "spaces") {
    run.root_share = summary.spaces.serial_share;
    run.island_bound = summary.spaces.island_bound;
  }
  take_times(measured_frames(data), summary, run);
  return run;
}

Figure6Bars read_figure6_bars(const ScalingRun& run) {
  const ParallelRates rates = parallel_rates(io::read_run(run.path), run.path);
  return {run.stepper, rates.islands_hz / rates.serial_hz, rates.spaces_hz / rates.serial_hz};
}

}  // namespace pbmpi::app
