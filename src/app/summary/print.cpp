#include <cstdio>

#include <nlohmann/json.hpp>

#include "app/summary/run_summary.h"

namespace pbmpi::app {
namespace {

/// printf into a string.
template <class... Args>
std::string format(const char* pattern, Args... args) {
  const int length = std::snprintf(nullptr, 0, pattern, args...);
  std::string text(static_cast<std::size_t>(length), '\0');
  std::snprintf(text.data(), text.size() + 1, pattern, args...);
  return text;
}

template <class Items, class ToText>
std::string join(const Items& items, ToText to_text) {
  std::string text;
  for (const auto& item : items) text += (text.empty() ? "" : ", ") + to_text(item);
  return text;
}

std::string run_lines(const RunSummary& s) {
  std::string text;
  text += format("scene: %s (%d worlds, %lld bodies)\n", s.scene.c_str(), s.worlds,
                 static_cast<long long>(s.bodies));
  text += format("ranks: %d on %s\n", s.ranks,
                 join(s.hosts, [](const std::string& host) { return host; }).c_str());
  if (!s.idle_ranks.empty()) {
    text += format("idle_ranks: %s (more ranks than worlds)\n",
                   join(s.idle_ranks, [](int rank) { return std::to_string(rank); }).c_str());
  }
  text +=
      format("stepper: %s, %d iterations, %d substeps, %s precision, dt %g s, %d steps a frame, seed %llu\n",
             s.stepper.c_str(), s.iterations, s.substeps, s.precision.c_str(), s.dt_s, s.steps_per_frame,
             static_cast<unsigned long long>(s.seed));
  if (!s.simd.empty()) text += "simd: " + s.simd + "\n";
  text += format("effects: %s\n", join(s.effects, [](const EffectSummary& e) { return e.name; }).c_str());
  if (!s.effects_chosen.empty()) text += "effects_chosen: " + s.effects_chosen + "\n";
  text += format("frames: %lld measured after %lld of warm-up%s\n", static_cast<long long>(s.measured_frames),
                 static_cast<long long>(s.warmup_frames), s.complete ? "" : " (stopped before the last)");
  return text;
}

std::string speed_lines(const RunSummary& s) {
  std::string text;
  text += format("frame_rate: %.1f Hz harmonic mean, %.0f %% of the frames within %.2f ms\n",
                 s.harmonic_mean_hz, 100 * s.satisfied_fraction, 1e3 * s.budget_s);
  text += format("frame_time: p50 %.3f ms, p95 %.3f ms, p99 %.3f ms, max %.3f ms\n", 1e3 * s.frame_p50_s,
                 1e3 * s.frame_p95_s, 1e3 * s.frame_p99_s, 1e3 * s.frame_max_s);
  text += format("throughput: %.0f world-steps/s (%.0f a rank), %.0f body-steps/s\n", s.world_steps_per_s,
                 s.world_steps_per_s / s.ranks, s.body_steps_per_s);
  for (const PhaseSummary& p : s.phases) {
    text += format("phase: %-11s min %9.3f ms (rank %d)  avg %9.3f ms  max %9.3f ms (rank %d)\n",
                   p.name.c_str(), 1e3 * p.min_s, p.min_rank, 1e3 * p.avg_s, 1e3 * p.max_s, p.max_rank);
  }
  text += format("efficiency: parallel %.1f %% = load balance %.1f %% x communication %.1f %%\n",
                 100 * s.parallel_efficiency, 100 * s.load_balance, 100 * s.communication_efficiency);
  if (s.rebalances > 0) {
    text += format("rebalances: %lld (%lld worlds moved)\n", static_cast<long long>(s.rebalances),
                   static_cast<long long>(s.worlds_moved));
  }
  return text;
}

std::string state_lines(const RunSummary& s) {
  std::string text;
  text += format("islands: max %.0f, min %.0f, mean %.2f, stddev %.2f\n", s.islands.max, s.islands.min,
                 s.islands.mean, s.islands.stddev);
  text += format("contacts: mean %.1f, max %.0f; rows: mean %.1f, max %.0f\n", s.contacts_mean,
                 s.contacts_max, s.rows_mean, s.rows_max);
  text +=
      format("invariants: %lld non-finite bodies, joint gap %.2f mm, penetration %.2f mm, energy %.1f J\n",
             static_cast<long long>(s.nonfinite_bodies), 1e3 * s.max_joint_gap_m, 1e3 * s.max_penetration_m,
             s.energy_j);
  text += "output: " + (s.output.empty() ? std::string("none") : s.output) + "\n";
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
                      {"max_rank", p.max_rank}});
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
  return run_lines(summary) + speed_lines(summary) + state_lines(summary);
}

std::string to_json(const RunSummary& s) {
  nlohmann::ordered_json json;
  json["program"] = "pbmpi";
  json["version"] = s.version;
  json["scene"] = s.scene;
  json["worlds"] = s.worlds;
  json["bodies"] = s.bodies;
  json["ranks"] = s.ranks;
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
  json["frames"] = {{"warmup", s.warmup_frames}, {"measured", s.measured_frames}};
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
  json["islands"] = {
      {"max", s.islands.max}, {"min", s.islands.min}, {"mean", s.islands.mean}, {"stddev", s.islands.stddev}};
  json["contacts"] = {{"mean", s.contacts_mean}, {"max", s.contacts_max}};
  json["rows"] = {{"mean", s.rows_mean}, {"max", s.rows_max}};
  json["invariants"] = {{"nonfinite_bodies", s.nonfinite_bodies},
                        {"max_joint_gap_m", s.max_joint_gap_m},
                        {"max_penetration_m", s.max_penetration_m},
                        {"energy_j", s.energy_j}};
  json["effects"] = effects_json(s);
  json["effects_chosen"] = s.effects_chosen;
  json["rebalances"] = {{"count", s.rebalances}, {"worlds_moved", s.worlds_moved}};
  json["output"] = s.output;
  json["state_hash"] = s.state_hash;
  return json.dump(2) + "\n";
}

}  // namespace pbmpi::app
