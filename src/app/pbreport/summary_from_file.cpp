#include "app/pbreport/summary_from_file.h"

#include <algorithm>
#include <functional>
#include <numeric>
#include <sstream>

#include "analysis/pose_errors.h"
#include "core/error.h"
#include "core/text.h"
#include "mpi/spaces/plan/rank_groups.h"
#include "stepping/frame.h"
#include "stepping/run_event.h"

namespace pbmpi::app {
namespace {

template <class Number>
Number number_of(const io::RunData& run, const std::string& name, const std::string& path) {
  std::istringstream text(core::value_in(run.parameters, name));
  Number number{};
  core::require_input(static_cast<bool>(text >> number),
                      path + ": /parameters has no number '" + name + "'; was the file written by pbmpi?");
  return number;
}

/// A column of /timings/rank summed over the ranks, for every frame.
std::vector<double> sum_over_ranks(const io::RunData& run, const std::string& name) {
  std::vector<double> sums(run.frame_measured.size(), 0);
  const auto found = run.rank_times.find(name);
  if (found == run.rank_times.end()) return sums;
  for (std::size_t frame = 0; frame < sums.size(); ++frame)
    sums[frame] = std::accumulate(found->second[frame].begin(), found->second[frame].end(), 0.0);
  return sums;
}

std::vector<double> only_measured(const std::vector<double>& values, const std::vector<bool>& measured) {
  std::vector<double> picked;
  for (std::size_t frame = 0; frame < values.size(); ++frame) {
    if (measured[frame]) picked.push_back(values[frame]);
  }
  return picked;
}

/// [R][T] seconds of the measured frames.
std::vector<std::vector<std::array<double, core::num_phases>>> phases_by_rank(const io::RunData& run) {
  std::vector<std::vector<std::array<double, core::num_phases>>> ranks(
      static_cast<std::size_t>(run.num_ranks));
  for (std::size_t frame = 0; frame < run.frame_measured.size(); ++frame) {
    if (!run.frame_measured[frame]) continue;
    for (std::size_t rank = 0; rank < ranks.size(); ++rank) {
      auto& phases = ranks[rank].emplace_back();
      for (std::size_t phase = 0; phase < phases.size(); ++phase) {
        const auto found = run.rank_times.find(std::string(core::phase_names[phase]));
        phases[phase] = found == run.rank_times.end() ? 0 : found->second[frame][rank];
      }
    }
  }
  return ranks;
}

/// [R] seconds over the measured frames; empty for a file of a layout before 1.8.
std::vector<double> processor_by_rank(const io::RunData& run) {
  const auto found = run.rank_times.find("processor");
  if (found == run.rank_times.end()) return {};
  std::vector<double> sums(static_cast<std::size_t>(run.num_ranks), 0);
  for (std::size_t frame = 0; frame < run.frame_measured.size(); ++frame) {
    if (!run.frame_measured[frame]) continue;
    std::ranges::transform(sums, found->second[frame], sums.begin(), std::plus());
  }
  return sums;
}

/// Ranks that spent no time on any world in the last frame.
std::vector<int> idle_ranks(const io::RunData& run) {
  std::vector<int> idle;
  const auto useful = run.rank_times.find("useful");
  if (useful == run.rank_times.end() || useful->second.empty()) return idle;
  for (int rank = 0; rank < run.num_ranks; ++rank) {
    if (useful->second.back()[static_cast<std::size_t>(rank)] == 0) idle.push_back(rank);
  }
  return idle;
}

/// The effects of the run's plan, of which each line is "friction: 12 contacts".
std::vector<EffectSummary> effects_of(const std::string& plan) {
  std::vector<EffectSummary> effects;
  std::istringstream lines(plan);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t end = line.find(": ");
    core::require_input(end != std::string::npos, "the attribute step_plan has a line '" + line + "'");
    effects.push_back({line.substr(0, end), line.substr(end + 2)});
  }
  return effects;
}

/// Events of a kind in the whole run, including those for which the file had no row.
std::int64_t num_events(const io::RunData& run, const char* kind) {
  const auto found = run.num_events.find(kind);
  return found == run.num_events.end() ? 0 : found->second;
}

/// For a run that was cut off, as far as its frames tell.
std::int64_t worlds_survived(const io::RunData& run) {
  if (!run.world_results.empty()) return std::ranges::count(run.world_results, 1, &io::WorldResult::survived);
  std::vector<bool> survived(static_cast<std::size_t>(run.num_worlds), true);
  if (const auto nonfinite = run.observables.find("nonfinite"); nonfinite != run.observables.end()) {
    for (const std::vector<double>& frame : nonfinite->second) {
      for (std::size_t world = 0; world < survived.size(); ++world)
        if (frame[world] > 0) survived[world] = false;
    }
  }
  for (const stepping::RunEvent& event : run.events) {
    if (event.kind == stepping::event_kind::frozen && event.world >= 0 && event.world < run.num_worlds)
      survived[static_cast<std::size_t>(event.world)] = false;
  }
  return std::ranges::count(survived, true);
}

void read_settings(const io::RunData& run, const std::string& path, RunSummary& summary) {
  summary.version = core::value_in(run.attributes, "pbmpi_version");
  summary.scene = core::value_in(run.attributes, "scene");
  summary.stepper = core::value_in(run.parameters, "stepper");
  summary.precision = core::value_in(run.parameters, "precision");
  summary.simd = core::value_in(run.parameters, "simd");
  if (core::value_in(run.parameters, "decompose") == "spaces") summary.decomposition = "spaces";
  summary.groups = mpi::rank_groups_from_text(core::value_in(run.parameters, "rank_groups"));
  if (run.parameters.contains("threads")) summary.threads = number_of<int>(run, "threads", path);
  summary.iterations = number_of<int>(run, "iterations", path);
  summary.substeps = number_of<int>(run, "substeps", path);
  summary.steps_per_frame = number_of<int>(run, "steps_per_frame", path);
  summary.dt_s = number_of<double>(run, "dt", path);
  summary.seed = number_of<std::uint64_t>(run, "seed", path);
  // Older files do not store their budget.
  summary.budget_s = run.parameters.contains("budget") ? number_of<double>(run, "budget", path)
                                                       : stepping::default_frame_budget_s;
}

/// The run's estimates against its precise poses, over recorded, measured frames.
EstimateSummary estimate_of(const io::RunData& run, const std::string& path, double budget_s) {
  EstimateSummary summary;
  summary.stepper = core::value_in(run.parameters, "estimate_stepper");
  summary.iterations = number_of<int>(run, "estimate_iterations", path);
  summary.precision = core::value_in(run.parameters, "estimate_precision");
  compute_delivery(only_measured(run.estimate.delivered_s, run.frame_measured),
                   only_measured(run.estimate.precise_s, run.frame_measured), budget_s, summary);
  const io::Motion &estimated = run.estimate.estimated, &precise = run.estimate.precise;
  const std::size_t record_every =
      precise.position.empty() ? 1 : run.frame_measured.size() / precise.position.size();
  std::vector<double> distances, angles;
  for (std::size_t row = 0; row < precise.position.size(); ++row) {
    if (!run.frame_measured[(row + 1) * record_every - 1]) continue;
    const analysis::PoseErrors errors =
        analysis::compare_bodies({estimated.position[row], estimated.orientation[row]},
                                 {precise.position[row], precise.orientation[row]});
    distances.insert(distances.end(), errors.body_position_m.begin(), errors.body_position_m.end());
    angles.insert(angles.end(), errors.body_orientation_rad.begin(), errors.body_orientation_rad.end());
  }
  summary.position_defect = analysis::summarize_positions(distances);
  summary.orientation_defect = analysis::summarize_orientations(angles);
  return summary;
}

}  // namespace

ObservedFrames observed_frames(const io::RunData& run) {
  ObservedFrames observed;
  observed.measured = run.frame_measured;
  for (std::size_t i = 0; i < stepping::world_observables.size(); ++i) {
    const auto found = run.observables.find(std::string(stepping::world_observables[i].name));
    if (found == run.observables.end()) continue;
    for (const std::vector<double>& worlds : found->second)
      observed.joined[i].push_back(stepping::join(stepping::world_observables[i].join, worlds));
  }
  return observed;
}

MeasuredFrames measured_frames(const io::RunData& run) {
  MeasuredFrames frames;
  frames.wall_s = only_measured(run.frame_wall_s, run.frame_measured);
  frames.phases = phases_by_rank(run);
  frames.processor_s = processor_by_rank(run);
  take_counts(observed_frames(run), frames);
  frames.messages = only_measured(sum_over_ranks(run, "messages"), run.frame_measured);
  frames.bytes = only_measured(sum_over_ranks(run, "bytes"), run.frame_measured);
  return frames;
}

RunSummary summary_from_file(const io::RunData& run, const std::string& path) {
  RunSummary summary;
  read_settings(run, path, summary);
  summary.output = path;
  summary.complete = run.complete;
  summary.state_hash = core::value_in(run.attributes, "state_hash");
  // The file has blanks in its place until the run ends.
  if (summary.state_hash.find_first_not_of(' ') == std::string::npos) {
    summary.state_hash = "none (the run was cut off)";
  }
  for (const std::string& host : run.hosts) {
    if (std::find(summary.hosts.begin(), summary.hosts.end(), host) == summary.hosts.end()) {
      summary.hosts.push_back(host);
    }
  }
  summary.worlds = run.num_worlds;
  summary.worlds_survived = worlds_survived(run);
  summary.ranks = run.num_ranks;
  summary.idle_ranks = idle_ranks(run);
  summary.bodies = run.num_bodies;
  summary.warmup_frames =
      std::find(run.frame_measured.begin(), run.frame_measured.end(), true) - run.frame_measured.begin();
  compute_performance(measured_frames(run), summary);

  summary.first_frame =
      std::atoll(core::value_in(run.attributes, "first_frame").c_str());  // files of 1.0 have none
  take_invariants(observed_frames(run), summary);
  summary.effects = effects_of(core::value_in(run.attributes, "step_plan"));
  summary.effects_chosen = core::value_in(run.parameters, "effects");
  summary.rebalances = num_events(run, stepping::event_kind::rebalance);
  summary.worlds_moved = run.worlds_moved;
  summary.joints_broken = num_events(run, stepping::event_kind::joint_broken);
  for (const stepping::RunEvent& event : run.events) summary.guards.add(event);
  for (auto& [kind, count] : summary.guards.counts)
    count = num_events(run, kind.c_str());  // some have no row
  if (!run.estimate.delivered_s.empty()) summary.estimate = estimate_of(run, path, summary.budget_s);
  return summary;
}

}  // namespace pbmpi::app
