#include "app/pbreport/suite/characterise.h"

#include <algorithm>
#include <numeric>

#include "analysis/schedule.h"
#include "core/error.h"
#include "core/text.h"
#include "stepping/frame_budget.h"

namespace pbmpi::app {
namespace {

double total(const std::vector<double>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

double phase_s(const io::RunData& run, const std::string& phase, std::size_t frame) {
  return total(run.rank_times.at(phase)[frame]);
}

std::vector<double> solve_times(const std::vector<io::IslandRow>& islands) {
  std::vector<double> times;
  times.reserve(islands.size());
  for (const io::IslandRow& island : islands) times.push_back(island.solve_s);
  return times;
}

/// The share with one thread per world: nothing crosses between worlds, so with spaces in parallel collision
/// detection takes as long as the longest of all worlds.
double spaces_share(const io::RunData& run, std::size_t frame) {
  const double serial_s = total(run.space_times.at("collide")[frame]);
  const auto& parallel = run.space_times.at("collide_spaces")[frame];
  return serial_s > 0 ? *std::max_element(parallel.begin(), parallel.end()) / serial_s : 1;
}

analysis::ParallelFrame parallel_frame(const io::RunData& run, std::size_t frame) {
  const std::vector<double> times = solve_times(run.islands[frame]);
  const double sum_s = total(times);
  analysis::ParallelFrame result;
  for (const char* phase : {"collide", "islands", "rows", "solve", "integrate"}) {
    result.serial_s += phase_s(run, phase, frame);
  }
  result.collide_s = phase_s(run, "collide", frame);
  result.solve_s = phase_s(run, "solve", frame);
  result.islands_share = sum_s > 0 ? *std::max_element(times.begin(), times.end()) / sum_s : 1;
  result.spaces_share = spaces_share(run, frame);
  return result;
}

Rate rate_of(const std::vector<double>& frame_s) {
  Rate rate;
  if (frame_s.empty()) return rate;
  const auto count = static_cast<double>(frame_s.size());
  rate.harmonic_mean_hz = count / total(frame_s);
  rate.satisfied_fraction =
      static_cast<double>(std::count_if(frame_s.begin(), frame_s.end(),
                                        [](double s) { return s <= stepping::default_frame_budget_s; })) /
      count;
  return rate;
}

std::vector<std::size_t> measured(const io::RunData& run) {
  std::vector<std::size_t> frames;
  for (std::size_t frame = 0; frame < run.frame_measured.size(); ++frame) {
    if (run.frame_measured[frame]) frames.push_back(frame);
  }
  return frames;
}

}  // namespace

const std::vector<PaperRow>& paper_rows() {
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
  return rows;
}

const PaperRow* paper_row(const std::string& scene) {
  const auto& rows = paper_rows();
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

CoreSummary summarize_cores(const io::RunData& run, const std::string& path) {
  core::require_input(!run.islands.empty(),
                      path + ": it has no times of islands; record the run with --record-islands");
  core::require_input(run.num_ranks == 1, path + ": it was run on " + std::to_string(run.num_ranks) +
                                              " ranks, whose times share the machine; use one rank");
  CoreSummary summary;
  summary.scene = core::value_in(run.attributes, "scene");
  std::vector<double> cores, shares, shares_parallel, shares_of_spaces, serial_s, islands_s, spaces_s;
  double collide_s = 0;
  for (const std::size_t frame : measured(run)) {
    cores.push_back(analysis::fewest_cores(solve_times(run.islands[frame]), cores_tolerance));
    const analysis::ParallelFrame times = parallel_frame(run, frame);
    collide_s += times.collide_s;
    shares.push_back(times.islands_share);
    shares_parallel.push_back(times.solve_s * times.islands_share / times.islands_parallel_s());
    shares_of_spaces.push_back(times.spaces_share);
    serial_s.push_back(times.serial_s);
    islands_s.push_back(times.islands_parallel_s());
    spaces_s.push_back(times.spaces_parallel_s());
  }
  core::require_input(!cores.empty(), path + ": the run ended in its warm-up; nothing was measured");
  summary.cores = static_cast<int>(core::summarize(cores).max);
  summary.cores_mean = core::summarize(cores).mean;
  summary.longest_share = core::summarize(shares).mean;
  summary.longest_share_parallel = core::summarize(shares_parallel).mean;
  summary.spaces_share = core::summarize(shares_of_spaces).mean;
  summary.serial = rate_of(serial_s);
  summary.islands_parallel = rate_of(islands_s);
  summary.spaces_parallel = rate_of(spaces_s);
  summary.collide_share_serial = collide_s / total(serial_s);
  summary.collide_share_parallel = collide_s / total(islands_s);
  return summary;
}

}  // namespace pbmpi::app
