#include <fmt/core.h>

#include <algorithm>
#include <cstdint>
#include <nlohmann/json.hpp>

#include "app/common/json_text.h"
#include "app/summary/run_summary.h"
#include "mpi/spaces/plan/rank_groups.h"

namespace pbmpi::app {
namespace {

template <class Items, class ToText>
std::string join(const Items& items, ToText to_text) {
  std::string text;
  for (const auto& item : items) text += (text.empty() ? "" : ", ") + to_text(item);
  return text;
}

/// Are many worlds cut?
bool are_groups(const RunSummary& s) { return s.groups.num_groups() > 0 && s.worlds > 1; }

/// From the sum of the measured frames [s] to the mean of one [ms].
double ms_a_frame(const RunSummary& s, double sum_s) {
  return 1e3 * sum_s / static_cast<double>(std::max<std::int64_t>(1, s.measured_frames));
}

std::string run_lines(const RunSummary& s) {
  std::string text;
  text += fmt::format("scene: {} ({} worlds, {} bodies)\n", s.scene, s.worlds, s.bodies);
  text +=
      fmt::format("ranks: {} on {}\n", s.ranks, join(s.hosts, [](const std::string& host) { return host; }));
  if (s.threads > 1) text += fmt::format("threads: {} in each rank\n", s.threads);
  if (are_groups(s)) text += "groups: " + in_words(s.groups) + ", each cuts worlds of its own into spaces\n";
  if (!s.idle_ranks.empty()) {
    text += fmt::format("idle_ranks: {} (more ranks than {})\n",
                        join(s.idle_ranks, [](int rank) { return std::to_string(rank); }),
                        are_groups(s) ? "groups and spaces" : s.decomposition);
  }
  text += fmt::format(
      "stepper: {}, {} iterations, {} substeps, {} precision, dt {:g} s, {} steps a frame, seed {}\n",
      s.stepper, s.iterations, s.substeps, s.precision, s.dt_s, s.steps_per_frame, s.seed);
  if (!s.simd.empty()) text += "simd: " + s.simd + "\n";
  text += fmt::format("effects: {}\n", join(s.effects, [](const EffectSummary& e) { return e.name; }));
  if (!s.effects_chosen.empty()) text += "effects_chosen: " + s.effects_chosen + "\n";
  text += fmt::format("frames: {} measured after {} of warm-up{}\n", s.measured_frames, s.warmup_frames,
                      s.complete ? "" : " (stopped before the last)");
  if (s.first_frame > 0) {
    text += fmt::format("resumed: after {} frames\n", s.first_frame);
  }
  return text;
}

std::string spaces_lines(const RunSummary& s) {
  const SpacesSummary& spaces = s.spaces;
  std::string text;
  for (int rank = 0; rank < s.ranks; ++rank) {
    text += fmt::format("rank: {:<3}", rank);
    for (const PhaseSummary& p : s.phases)
      text += fmt::format(" {} {:.3f}", p.name, ms_a_frame(s, p.by_rank_s[static_cast<std::size_t>(rank)]));
    text += " ms a frame\n";
  }
  text += fmt::format(
      "spaces: serial share {:.2f} % ({}), so at most {:.2f} times one rank (Amdahl), {:.2f} with the "
      "largest island on one rank; measured {:.2f} (work over elapsed time)\n",
      100 * spaces.serial_share, are_groups(s) ? "sections of the groups' roots" : "root's section",
      spaces.amdahl_bound, spaces.island_bound, spaces.speed_up);
  text += fmt::format("traffic: {:.1f} messages and {:.0f} bytes a step\n", spaces.messages_per_step,
                      spaces.bytes_per_step);
  return text;
}

std::string speed_lines(const RunSummary& s) {
  std::string text;
  text += fmt::format("frame_rate: {:.1f} Hz harmonic mean, {:.0f} % of the frames within {:.2f} ms\n",
                      s.harmonic_mean_hz, 100 * s.satisfied_fraction, 1e3 * s.budget_s);
  text += fmt::format("frame_time: p50 {:.3f} ms, p95 {:.3f} ms, p99 {:.3f} ms, max {:.3f} ms\n",
                      1e3 * s.frame_p50_s, 1e3 * s.frame_p95_s, 1e3 * s.frame_p99_s, 1e3 * s.frame_max_s);
  text += fmt::format("throughput: {:.0f} world-steps/s ({:.0f} a rank), {:.0f} body-steps/s\n",
                      s.world_steps_per_s, s.world_steps_per_s / s.ranks, s.body_steps_per_s);
  for (const PhaseSummary& p : s.phases) {
    text += fmt::format(
        "phase: {:11} min {:>9.3f} ms (rank {})  avg {:>9.3f} ms  max {:>9.3f} ms (rank {}) a frame\n",
        p.name, ms_a_frame(s, p.min_s), p.min_rank, ms_a_frame(s, p.avg_s), ms_a_frame(s, p.max_s),
        p.max_rank);
  }
  text += fmt::format("efficiency: parallel {:.1f} % = load balance {:.1f} % x communication {:.1f} %\n",
                      100 * s.parallel_efficiency, 100 * s.load_balance, 100 * s.communication_efficiency);
  if (s.ranks > 1 && s.processor.busiest_s > 0) {
    text += fmt::format(
        "processor: {:.3f} ms a frame on the busiest rank ({}), {:.3f} ms on the mean one, without waiting\n",
        1e3 * s.processor.busiest_s, s.processor.busiest_rank, 1e3 * s.processor.mean_s);
  }
  if (s.decomposition == "spaces") {
    text += spaces_lines(s);
  } else if (s.ranks > 1) {
    text += fmt::format("traffic: {:.1f} messages and {:.0f} bytes a frame\n", s.messages_per_frame,
                        s.bytes_per_frame);
  }
  if (s.rebalances > 0) {
    text += fmt::format("rebalances: {} ({} {} moved)\n", s.rebalances, s.worlds_moved, s.decomposition);
  }
  if (s.memory.max_bytes > 0) {
    constexpr double mib = 1024.0 * 1024;
    text += fmt::format("memory: peak of a rank min {:.1f} MiB (rank {}), max {:.1f} MiB (rank {})\n",
                        static_cast<double>(s.memory.min_bytes) / mib, s.memory.min_rank,
                        static_cast<double>(s.memory.max_bytes) / mib, s.memory.max_rank);
  }
  return text;
}

template <class Names>
std::string bands_text(const analysis::ErrorSummary& errors, const Names& names) {
  std::string text;
  for (std::size_t band = 0; band < names.size(); ++band) {
    text += fmt::format("{}{} {}", band == 0 ? "" : ", ", errors.bands[band], names[band]);
  }
  return text;
}

std::string estimate_lines(const EstimateSummary& e, double budget_s) {
  std::string text;
  text += fmt::format(
      "estimate: {}, {} iterations, {} precision; delivered p50 {:.3f} ms, p99 {:.3f} ms, max {:.3f} ms\n",
      e.stepper, e.iterations, e.precision, 1e3 * e.delivered_p50_s, 1e3 * e.delivered_p99_s,
      1e3 * e.delivered_max_s);
  text += fmt::format(
      "estimate_rate: {:.1f} Hz harmonic mean, {:.0f} % of the estimates within {:.2f} ms, precise {:.2f} "
      "times later\n",
      e.harmonic_mean_hz, 100 * e.satisfied_fraction, 1e3 * budget_s, e.precise_over_delivered);
  text += fmt::format("estimate_defect: position rms {:.3g} mm, p99 {:.3g} mm, max {:.3g} mm ({})\n",
                      1e3 * e.position_defect.rms, 1e3 * e.position_defect.p99, 1e3 * e.position_defect.max,
                      bands_text(e.position_defect, analysis::position_band_names));
  text += fmt::format("estimate_defect: orientation rms {:.3g} rad, p99 {:.3g} rad, max {:.3g} rad ({})\n",
                      e.orientation_defect.rms, e.orientation_defect.p99, e.orientation_defect.max,
                      bands_text(e.orientation_defect, analysis::orientation_band_names));
  return text;
}

nlohmann::ordered_json errors_json(const analysis::ErrorSummary& e) {
  return {{"count", e.count}, {"rms", e.rms}, {"p99", e.p99}, {"max", e.max}, {"bands", e.bands}};
}

nlohmann::ordered_json estimate_json(const EstimateSummary& e) {
  return {
      {"stepper", e.stepper},
      {"iterations", e.iterations},
      {"precision", e.precision},
      {"delivered_s", {{"p50", e.delivered_p50_s}, {"p99", e.delivered_p99_s}, {"max", e.delivered_max_s}}},
      {"harmonic_mean_hz", e.harmonic_mean_hz},
      {"satisfied_fraction", e.satisfied_fraction},
      {"precise_over_delivered", e.precise_over_delivered},
      {"position_defect_m", errors_json(e.position_defect)},
      {"orientation_defect_rad", errors_json(e.orientation_defect)}};
}

std::string guard_lines(const GuardSummary& guards) {
  if (guards.counts.empty()) return "";
  const std::string counts =
      join(guards.counts, [](const auto& one) { return fmt::format("{} {}", one.second, one.first); });
  return "guards: " + counts + (guards.first.empty() ? "" : "; first: " + guards.first) + "\n";
}

nlohmann::ordered_json guards_json(const GuardSummary& guards) {
  nlohmann::ordered_json json;
  for (const char* kind : stepping::event_kind::guards) json[kind] = guards.count(kind);
  for (const char* kind : stepping::event_kind::guard_actions) json[kind] = guards.count(kind);
  json["first"] = guards.first;
  return json;
}

std::string state_lines(const RunSummary& s) {
  std::string text;
  text += fmt::format("islands: max {:.0f}, min {:.0f}, mean {:.2f}, stddev {:.2f}\n", s.islands.max,
                      s.islands.min, s.islands.mean, s.islands.stddev);
  text += fmt::format("contacts: mean {:.1f}, max {:.0f}; rows: mean {:.1f}, max {:.0f}\n", s.contacts_mean,
                      s.contacts_max, s.rows_mean, s.rows_max);
  text += fmt::format(
      "invariants: {} non-finite bodies, joint gap {:.2f} mm, penetration {:.2f} mm, energy {:.1f} J\n",
      s.nonfinite_bodies, 1e3 * s.max_joint_gap_m, 1e3 * s.max_penetration_m, s.energy_j);
  text += fmt::format("worlds_survived: {} of {}\n", s.worlds_survived, s.worlds);
  if (s.joints_broken > 0) text += fmt::format("joints_broken: {}\n", s.joints_broken);
  text += guard_lines(s.guards);
  text += "output: " + (s.output.empty() ? std::string("none") : s.output) + "\n";
  if (!s.checkpoint.empty()) text += "checkpoint: " + s.checkpoint + "\n";
  text += "state_hash: " + s.state_hash + "\n";
  return text;
}

nlohmann::ordered_json phases_json(const RunSummary& s) {
  auto phases = nlohmann::ordered_json::array();
  for (const PhaseSummary& p : s.phases) {
    phases.push_back({{"name", p.name},
                      {"min_s", p.min_s},
                      {"min_rank", p.min_rank},
                      {"avg_s", p.avg_s},
                      {"max_s", p.max_s},
                      {"max_rank", p.max_rank},
                      {"by_rank_s", p.by_rank_s}});
  }
  return phases;
}

nlohmann::ordered_json effects_json(const RunSummary& s) {
  auto effects = nlohmann::ordered_json::array();
  for (const EffectSummary& e : s.effects) effects.push_back({{"name", e.name}, {"reason", e.reason}});
  return effects;
}

}  // namespace

std::string to_text(const RunSummary& summary) {
  const std::string estimate = summary.estimate ? estimate_lines(*summary.estimate, summary.budget_s) : "";
  return run_lines(summary) + speed_lines(summary) + estimate + state_lines(summary);
}

std::string to_json(const RunSummary& s) {
  nlohmann::ordered_json json;
  json["program"] = "pbmpi";
  json["version"] = s.version;
  json["scene"] = s.scene;
  json["worlds"] = s.worlds;
  json["bodies"] = s.bodies;
  json["ranks"] = s.ranks;
  json["threads"] = s.threads;
  json["hosts"] = s.hosts;
  json["idle_ranks"] = s.idle_ranks;
  json["stepper"] = s.stepper;
  json["iterations"] = s.iterations;
  json["substeps"] = s.substeps;
  json["precision"] = s.precision;
  json["simd"] = s.simd;
  json["dt"] = s.dt_s;
  json["steps_per_frame"] = s.steps_per_frame;
  json["seed"] = s.seed;
  json["complete"] = s.complete;
  json["frames"] = {{"warmup", s.warmup_frames}, {"measured", s.measured_frames}, {"before", s.first_frame}};
  json["frame_rate"] = {{"harmonic_mean_hz", s.harmonic_mean_hz},
                        {"satisfied_fraction", s.satisfied_fraction},
                        {"budget_s", s.budget_s}};
  json["throughput"] = {{"world_steps_per_s", s.world_steps_per_s},
                        {"world_steps_per_s_per_rank", s.world_steps_per_s / s.ranks},
                        {"body_steps_per_s", s.body_steps_per_s}};
  json["frame_time_s"] = {
      {"p50", s.frame_p50_s}, {"p95", s.frame_p95_s}, {"p99", s.frame_p99_s}, {"max", s.frame_max_s}};
  json["phases"] = phases_json(s);
  json["efficiency"] = {{"parallel", s.parallel_efficiency},
                        {"load_balance", s.load_balance},
                        {"communication", s.communication_efficiency}};
  json["traffic"] = {{"messages_per_frame", s.messages_per_frame}, {"bytes_per_frame", s.bytes_per_frame}};
  if (s.processor.busiest_s > 0) {
    json["processor_time"] = {{"busiest_s", s.processor.busiest_s},
                              {"busiest_rank", s.processor.busiest_rank},
                              {"mean_s", s.processor.mean_s}};
  }
  if (s.memory.max_bytes > 0) {
    json["memory"] = {{"min_bytes", s.memory.min_bytes},
                      {"min_rank", s.memory.min_rank},
                      {"max_bytes", s.memory.max_bytes},
                      {"max_rank", s.memory.max_rank}};
  }
  json["islands"] = {
      {"max", s.islands.max}, {"min", s.islands.min}, {"mean", s.islands.mean}, {"stddev", s.islands.stddev}};
  json["contacts"] = {{"mean", s.contacts_mean}, {"max", s.contacts_max}};
  json["rows"] = {{"mean", s.rows_mean}, {"max", s.rows_max}};
  json["invariants"] = {{"nonfinite_bodies", s.nonfinite_bodies},
                        {"max_joint_gap_m", s.max_joint_gap_m},
                        {"max_penetration_m", s.max_penetration_m},
                        {"energy_j", s.energy_j}};
  json["worlds_survived"] = s.worlds_survived;
  json["joints_broken"] = s.joints_broken;
  json["guards"] = guards_json(s.guards);
  json["effects"] = effects_json(s);
  json["effects_chosen"] = s.effects_chosen;
  json["decomposition"] = s.decomposition;
  if (s.decomposition == "spaces") {
    json["spaces"] = {
        {"serial_share", s.spaces.serial_share},           {"amdahl_bound", s.spaces.amdahl_bound},
        {"island_bound", s.spaces.island_bound},           {"speed_up", s.spaces.speed_up},
        {"messages_per_step", s.spaces.messages_per_step}, {"bytes_per_step", s.spaces.bytes_per_step}};
    for (int group = 0; are_groups(s) && group < s.groups.num_groups(); ++group)
      json["spaces"]["groups"].push_back({{"ranks", s.groups.ranks[static_cast<std::size_t>(group)]},
                                          {"worlds", s.groups.worlds[static_cast<std::size_t>(group)]}});
  }
  json["rebalances"] = {{"count", s.rebalances}, {"worlds_moved", s.worlds_moved}};  // or spaces
  if (s.estimate) json["estimate"] = estimate_json(*s.estimate);
  json["output"] = s.output;
  json["checkpoint"] = s.checkpoint;
  json["state_hash"] = s.state_hash;
  return json_text(json, 2) + "\n";
}

}  // namespace pbmpi::app
