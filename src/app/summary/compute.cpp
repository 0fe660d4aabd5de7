#include <algorithm>
#include <numeric>

#include "app/summary/run_summary.h"

namespace pbmpi::app {

using stepping::column_of;
using stepping::Observables;

namespace {

double sum(const std::vector<double>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

double mean(const std::vector<double>& values) {
  return values.empty() ? 0 : sum(values) / static_cast<double>(values.size());
}

double largest(const std::vector<double>& values) {
  return values.empty() ? 0 : *std::max_element(values.begin(), values.end());
}

/// Seconds of one rank in one phase over all frames.
double phase_total(const std::vector<std::array<double, core::num_phases>>& rank, int phase) {
  double total = 0;
  for (const auto& frame : rank) total += frame[static_cast<std::size_t>(phase)];
  return total;
}

std::vector<PhaseSummary> summarize_phases(const MeasuredFrames& frames) {
  std::vector<PhaseSummary> phases;
  for (int phase = 0; phase < core::num_phases; ++phase) {
    std::vector<double> totals;
    for (const auto& rank : frames.phases) totals.push_back(phase_total(rank, phase));
    if (largest(totals) == 0) continue;
    const auto [min, max] = std::minmax_element(totals.begin(), totals.end());
    phases.push_back({std::string(core::phase_names[static_cast<std::size_t>(phase)]), *min, mean(totals),
                      *max, static_cast<int>(min - totals.begin()), static_cast<int>(max - totals.begin()),
                      totals});
  }
  return phases;
}

void compute_efficiency(const MeasuredFrames& frames, double elapsed_s, RunSummary& summary) {
  std::vector<double> useful;
  for (const auto& rank : frames.phases) {
    double total = 0;
    for (const auto& frame : rank) total += core::PhaseTimes{frame}.useful_s();
    useful.push_back(total);
  }
  if (largest(useful) <= 0 || elapsed_s <= 0) return;
  summary.load_balance = mean(useful) / largest(useful);
  summary.communication_efficiency = std::min(1.0, largest(useful) / elapsed_s);
  summary.parallel_efficiency = summary.load_balance * summary.communication_efficiency;
}

ProcessorSummary summarize_processor(const MeasuredFrames& frames) {
  const auto busiest = std::ranges::max_element(frames.processor_s);
  if (busiest == frames.processor_s.end() || frames.wall_s.empty()) return {};
  const auto num_frames = static_cast<double>(frames.wall_s.size());
  return {*busiest / num_frames, mean(frames.processor_s) / num_frames,
          static_cast<int>(busiest - frames.processor_s.begin())};
}

/// Seconds of all ranks in one frame.
struct FrameWork {
  double collide_s = 0, solve_s = 0, section_s = 0;
};

FrameWork work_of_frame(const MeasuredFrames& frames, std::size_t frame) {
  FrameWork work;
  for (const auto& rank : frames.phases) {
    const core::PhaseTimes times{rank[frame]};
    work.collide_s += times[core::Phase::collide] + times[core::Phase::islands];
    work.solve_s += times[core::Phase::rows] + times[core::Phase::solve] + times[core::Phase::integrate];
    work.section_s += times[core::Phase::cross_space];
  }
  return work;
}

void compute_spaces(const MeasuredFrames& frames, double elapsed_s, RunSummary& summary) {
  const auto ranks = static_cast<double>(summary.ranks);
  const auto num_groups = static_cast<double>(std::max(1, summary.groups.num_groups()));
  double work_s = 0, section_s = 0, island_bound_s = 0;
  for (std::size_t frame = 0; frame < frames.wall_s.size(); ++frame) {
    const FrameWork work = work_of_frame(frames, frame);
    const double share = frames.rows[frame] > 0 ? frames.max_island_rows[frame] / frames.rows[frame] : 0;
    work_s += work.collide_s + work.solve_s;
    section_s += work.section_s;
    island_bound_s +=
        work.section_s / num_groups + work.collide_s / ranks + work.solve_s * std::max(share, 1 / ranks);
  }
  if (work_s <= 0 || elapsed_s <= 0) return;
  SpacesSummary& spaces = summary.spaces;
  spaces.serial_share = section_s / (section_s + work_s);
  spaces.amdahl_bound = work_s / (section_s / num_groups + work_s / ranks);
  spaces.island_bound = work_s / island_bound_s;
  spaces.speed_up = work_s / elapsed_s;
  const double steps = static_cast<double>(frames.wall_s.size()) * summary.steps_per_frame;
  spaces.messages_per_step = sum(frames.messages) / steps;
  spaces.bytes_per_step = sum(frames.bytes) / steps;
}

}  // namespace

void compute_performance(const MeasuredFrames& frames, RunSummary& summary) {
  const double elapsed_s = sum(frames.wall_s);
  const auto num_frames = static_cast<double>(frames.wall_s.size());
  summary.measured_frames = static_cast<std::int64_t>(frames.wall_s.size());
  if (elapsed_s > 0) {
    const double steps_per_s = num_frames * summary.steps_per_frame / elapsed_s;
    summary.harmonic_mean_hz = num_frames / elapsed_s;
    summary.world_steps_per_s = steps_per_s * summary.worlds;
    summary.body_steps_per_s = steps_per_s * static_cast<double>(summary.bodies);
    const auto satisfied = std::count_if(frames.wall_s.begin(), frames.wall_s.end(),
                                         [&](double wall_s) { return wall_s <= summary.budget_s; });
    summary.satisfied_fraction = static_cast<double>(satisfied) / num_frames;
  }
  summary.frame_p50_s = core::quantile(frames.wall_s, 0.50);
  summary.frame_p95_s = core::quantile(frames.wall_s, 0.95);
  summary.frame_p99_s = core::quantile(frames.wall_s, 0.99);
  summary.frame_max_s = largest(frames.wall_s);
  summary.phases = summarize_phases(frames);
  compute_efficiency(frames, elapsed_s, summary);
  summary.processor = summarize_processor(frames);
  summary.messages_per_frame = mean(frames.messages);
  summary.bytes_per_frame = mean(frames.bytes);
  if (summary.decomposition == "spaces") compute_spaces(frames, elapsed_s, summary);
  summary.islands = core::summarize(frames.islands);
  summary.contacts_mean = mean(frames.contacts);
  summary.contacts_max = largest(frames.contacts);
  summary.rows_mean = mean(frames.rows);
  summary.rows_max = largest(frames.rows);
}

void GuardSummary::add(const stepping::RunEvent& event) {
  namespace event_kind = stepping::event_kind;
  const auto is = [&](const char* kind) { return event.kind == kind; };
  const bool tripped = std::ranges::any_of(event_kind::guards, is);
  if (!tripped && std::ranges::none_of(event_kind::guard_actions, is)) return;
  ++counts[event.kind];
  if (tripped && first.empty()) first = event.detail;
}

std::int64_t GuardSummary::count(const std::string& kind) const {
  const auto found = counts.find(kind);
  return found == counts.end() ? 0 : found->second;
}

void compute_delivery(const std::vector<double>& delivered_s, const std::vector<double>& precise_s,
                      double budget_s, EstimateSummary& estimate) {
  const double elapsed_s = sum(delivered_s);
  if (elapsed_s <= 0) return;
  const auto num_frames = static_cast<double>(delivered_s.size());
  const auto satisfied = std::count_if(delivered_s.begin(), delivered_s.end(),
                                       [&](double time_s) { return time_s <= budget_s; });
  estimate.delivered_p50_s = core::quantile(delivered_s, 0.50);
  estimate.delivered_p99_s = core::quantile(delivered_s, 0.99);
  estimate.delivered_max_s = largest(delivered_s);
  estimate.harmonic_mean_hz = num_frames / elapsed_s;
  estimate.satisfied_fraction = static_cast<double>(satisfied) / num_frames;
  estimate.precise_over_delivered = sum(precise_s) / elapsed_s;
}

std::vector<double> ObservedFrames::measured_of(std::size_t column) const {
  std::vector<double> picked;
  for (std::size_t frame = 0; frame < measured.size(); ++frame) {
    if (measured[frame]) picked.push_back(joined[column].empty() ? 0 : joined[column][frame]);
  }
  return picked;
}

double ObservedFrames::last(std::size_t column) const {
  return joined[column].empty() ? 0 : joined[column].back();
}

double ObservedFrames::first(std::size_t column) const {
  return joined[column].empty() ? 0 : joined[column].front();
}

double ObservedFrames::largest_measured(std::size_t column) const {
  double largest = 0;
  for (const double value : measured_of(column)) largest = std::max(largest, value);
  return largest;
}

void take_counts(const ObservedFrames& observed, MeasuredFrames& frames) {
  frames.islands = observed.measured_of(column_of(&Observables::islands));
  frames.contacts = observed.measured_of(column_of(&Observables::contacts));
  frames.rows = observed.measured_of(column_of(&Observables::rows));
  frames.max_island_rows = observed.measured_of(column_of(&Observables::max_island_rows));
}

void take_invariants(const ObservedFrames& observed, RunSummary& summary) {
  summary.energy_j = observed.last(column_of(&Observables::energy_j));
  summary.nonfinite_bodies = static_cast<std::int64_t>(observed.last(column_of(&Observables::nonfinite)));
  summary.max_joint_gap_m = observed.largest_measured(column_of(&Observables::joint_gap_m));
  summary.max_penetration_m = observed.largest_measured(column_of(&Observables::max_penetration_m));
}

std::vector<EffectSummary> effect_summaries(const effects::RunPlan& plan) {
  std::vector<EffectSummary> effects;
  for (const effects::RunPass& pass : plan.passes())
    effects.push_back({std::string(pass.effect->name), pass.reason});
  return effects;
}

}  // namespace pbmpi::app
