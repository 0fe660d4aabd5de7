#include "app/pbreport/suite/characterise.h"

#include <algorithm>
#include <numeric>

#include "core/error.h"
#include "core/text.h"

namespace pbmpi::app {
namespace {

double total(const std::vector<double>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

double phase_s(const io::RunData& run, const std::string& phase, std::size_t frame) {
  return total(run.rank_times.at(phase)[frame]);
}

/// The longest island over all islands of the profiled step.
double longest_share(const std::vector<io::IslandRow>& islands) {
  double longest_s = 0, sum_s = 0;
  for (const io::IslandRow& island : islands) {
    longest_s = std::max(longest_s, island.solve_s);
    sum_s += island.solve_s;
  }
  return sum_s > 0 ? longest_s / sum_s : 1;
}

/// Collision detection with a core for each space over that in one piece. One thread per world: nothing
/// crosses between worlds, so that it takes as long as the longest of all worlds.
double spaces_share(const io::RunData& run, std::size_t frame) {
  const double serial_s = total(run.space_times.at("collide")[frame]);
  return serial_s > 0 ? std::ranges::max(run.space_times.at("collide_spaces")[frame]) / serial_s : 1;
}

std::vector<std::size_t> measured(const io::RunData& run) {
  std::vector<std::size_t> frames;
  for (std::size_t frame = 0; frame < run.frame_measured.size(); ++frame) {
    if (run.frame_measured[frame]) frames.push_back(frame);
  }
  return frames;
}

}  // namespace

const PaperRow* paper_row(const std::string& scene) {
  static const std::vector<PaperRow> rows = {
      {"2-Cars", 2, 2, 2, 0, "1", "none", 2},
      {"10-Cars", 10, 10, 10, 0, "1", "none", 9},
      {"CrashSk", 3, 1, 2, 0.65, "1", "none", 3},
      {"CrashWa", 105, 99, 101, 1.4, "1, 3", "none to high", 3},
      {"Environ", 337, 196, 245, 46, "1, 10", "high", 4},
      {"100CrSk", 300, 100, 220, 64, "100", "none", 100},
      {"Battle", 120, 2, 93, 18, "1, 3", "none", 19},
      {"Fight", 10, 7, 8, 1.1, "1, 10", "moderate", 4},
      {"Battle2", 156, 113, 134, 18, "1, 15", "high", 3},
  };
  const auto found =
      std::find_if(rows.begin(), rows.end(), [&](const PaperRow& row) { return row.scene == scene; });
  return found == rows.end() ? nullptr : &*found;
}

IslandSummary summarize_islands(const io::RunData& run) {
  IslandSummary summary;
  summary.scene = core::value_in(run.attributes, "scene");
  const std::string spaces = core::value_in(run.parameters, "num_spaces");
  summary.spaces = run.num_worlds * std::max(1, std::atoi(spaces.c_str()));
  summary.has_profile = !run.islands.empty();
  std::vector<double> islands, crossing;
  for (const std::size_t frame : measured(run)) {
    islands.push_back(total(run.observables.at("islands")[frame]));
    if (summary.has_profile) crossing.push_back(total(run.space_times.at("cross_contacts")[frame]));
  }
  summary.islands = core::summarize(islands);
  summary.cross_contacts = core::summarize(crossing).mean;
  return summary;
}

ParallelRates parallel_rates(const io::RunData& run, const std::string& path) {
  core::require_input(!run.islands.empty(),
                      path + ": it has no times of islands; record the run with --record-islands");
  core::require_input(run.num_ranks == 1, path + ": it was run on " + std::to_string(run.num_ranks) +
                                              " ranks, whose times share the machine; use one rank");
  const std::vector<std::size_t> frames = measured(run);
  core::require_input(!frames.empty(), path + ": the run ended in its warm-up; nothing was measured");
  double serial_s = 0, islands_s = 0, spaces_s = 0;
  for (const std::size_t frame : frames) {
    double frame_s = 0;
    for (const char* phase : {"collide", "islands", "rows", "solve", "integrate"})
      frame_s += phase_s(run, phase, frame);
    const double collide_s = phase_s(run, "collide", frame), solve_s = phase_s(run, "solve", frame);
    const double parallel_s = frame_s - solve_s + solve_s * longest_share(run.islands[frame]);
    serial_s += frame_s;
    islands_s += parallel_s;
    spaces_s += parallel_s - collide_s + collide_s * spaces_share(run, frame);
  }
  const auto num = static_cast<double>(frames.size());
  return {num / serial_s, num / islands_s, num / spaces_s};
}

}  // namespace pbmpi::app
