#include "app/pbreport/run/facts.h"

#include <fmt/core.h>

namespace pbmpi::app {
namespace {

/// "37,000" for 37000.
std::string with_commas(std::int64_t number) {
  std::string text = std::to_string(number);
  for (int place = static_cast<int>(text.size()) - 3; place > 0; place -= 3) {
    text.insert(static_cast<std::size_t>(place), ",");
  }
  return text;
}

std::string counted(std::int64_t count, const char* one, const char* many) {
  return with_commas(count) + " " + (count == 1 ? one : many);
}

}  // namespace

std::vector<io::html::Fact> facts_of(const RunSummary& s) {
  const std::string sweeps =
      (s.substeps > 1 ? counted(s.substeps, "substep", "substeps") + " of " : std::string()) +
      counted(s.iterations, "iteration", "iterations");
  std::vector<io::html::Fact> facts = {
      {"Size", counted(s.bodies, "body", "bodies"), "in " + counted(s.worlds, "world", "worlds")},
      {"Ranks", with_commas(s.ranks),
       "on " + counted(static_cast<std::int64_t>(s.hosts.size()), "host", "hosts")},
      {"Stepper", s.stepper, sweeps + fmt::format(", dt {:g} ms", 1e3 * s.dt_s)},
  };
  if (s.measured_frames == 0) {
    facts.push_back({"Frame rate", "not measured", "the run ended in its warm-up"});
    return facts;
  }
  facts.push_back({"Frame rate", fmt::format("{:.0f} Hz", s.harmonic_mean_hz),
                   "harmonic mean of " + counted(s.measured_frames, "frame", "frames")});
  facts.push_back({"Within budget", fmt::format("{:.0f} %", 100 * s.satisfied_fraction),
                   fmt::format("of frames in {:.2f} ms", 1e3 * s.budget_s)});
  facts.push_back({"Frame time", fmt::format("{:.2f} ms", 1e3 * s.frame_p50_s),
                   fmt::format("median; p99 {:.2f}, max {:.2f}", 1e3 * s.frame_p99_s, 1e3 * s.frame_max_s)});
  facts.push_back({"Efficiency", fmt::format("{:.0f} %", 100 * s.parallel_efficiency),
                   fmt::format("balance {:.0f} % × comm. {:.0f} %", 100 * s.load_balance,
                               100 * s.communication_efficiency)});
  if (s.estimate) {
    facts.push_back({"Estimate", fmt::format("{:.2f} ms", 1e3 * s.estimate->delivered_p50_s),
                     fmt::format("delivered; precise {:.1f} × later, rms off {:.1f} mm",
                                 s.estimate->precise_over_delivered, 1e3 * s.estimate->position_defect.rms)});
  }
  facts.push_back({"Invariants", fmt::format("{:.2f} mm", 1e3 * s.max_joint_gap_m),
                   fmt::format("joint gap; penetration {:.2f} mm", 1e3 * s.max_penetration_m)});
  return facts;
}

}  // namespace pbmpi::app
