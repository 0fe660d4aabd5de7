#include "io/html/plot_data.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <numeric>

#include "core/clock.h"
#include "core/statistics.h"
#include "io/html/escape.h"
#include "io/html/replay_data.h"

namespace pbmpi::io::html {
namespace {

using nlohmann::json;

/// Calls visit(first, last) for each bin of `count` frames.
template <class Visit>
void for_each_bin(std::size_t count, std::size_t per_bin, Visit visit) {
  for (std::size_t first = 0; first < count; first += per_bin) {
    visit(first, std::min(count, first + per_bin));
  }
}

json to_json(const Band& band, double scale = 1) {
  const auto scaled = [scale](std::vector<double> values) {
    for (double& value : values) value *= scale;
    return values;
  };
  return {{"sum", scaled(band.sum)},
          {"min", scaled(band.min)},
          {"mean", scaled(band.mean)},
          {"max", scaled(band.max)}};
}

/// JSON of an observable's band; null if the run has no such observable.
json band_json(const RunData& run, const std::string& observable, std::size_t per_bin, double scale = 1) {
  const auto found = run.observables.find(observable);
  return found == run.observables.end() ? json() : to_json(band_of(found->second, per_bin), scale);
}
json length_json(const RunData& run, const std::string& observable, std::size_t per_bin) {
  const auto found = run.vector_observables.find(observable);
  return found == run.vector_observables.end() ? json()
                                               : to_json(band_of(lengths_of(found->second), per_bin));
}

/// [num_ranks] mean of one phase over the measured frames (over all frames if none is measured), in ms.
std::vector<double> mean_ms_per_rank(const RunData& run, const Table& seconds) {
  const bool any =
      std::find(run.frame_measured.begin(), run.frame_measured.end(), true) != run.frame_measured.end();
  std::vector<double> mean(static_cast<std::size_t>(run.num_ranks));
  double count = 0;
  for (std::size_t frame = 0; frame < seconds.size(); ++frame) {
    if (any && !run.frame_measured[frame]) continue;
    ++count;
    for (std::size_t rank = 0; rank < mean.size(); ++rank) mean[rank] += 1e3 * seconds[frame][rank];
  }
  for (double& m : mean) m /= std::max(1.0, count);
  return mean;
}

/// Phases in the order of the step; phases in which no rank spent any time are left out.
json phases_json(const RunData& run) {
  json phases = json::array();
  for (std::string_view name : core::phase_names) {
    const auto found = run.rank_times.find(std::string(name));
    if (found == run.rank_times.end()) continue;
    const std::vector<double> mean_ms = mean_ms_per_rank(run, found->second);
    if (std::all_of(mean_ms.begin(), mean_ms.end(), [](double m) { return m == 0; })) continue;
    phases.push_back({{"name", name}, {"mean_ms", mean_ms}});
  }
  return phases;
}

}  // namespace

Band band_of(const Table& table, std::size_t per_bin) {
  Band band;
  for_each_bin(table.size(), per_bin, [&](std::size_t first, std::size_t last) {
    double sum = 0, mean = 0, min = 0, max = 0;
    for (std::size_t frame = first; frame < last; ++frame) {
      const core::Summary worlds = core::summarize(table[frame]);
      sum += std::accumulate(table[frame].begin(), table[frame].end(), 0.0);
      mean += worlds.mean;
      min = frame == first ? worlds.min : std::min(min, worlds.min);
      max = frame == first ? worlds.max : std::max(max, worlds.max);
    }
    const auto frames = static_cast<double>(last - first);
    band.sum.push_back(sum / frames);
    band.mean.push_back(mean / frames);
    band.min.push_back(min);
    band.max.push_back(max);
  });
  return band;
}

std::vector<double> largest_of_bins(const std::vector<double>& values, std::size_t per_bin) {
  std::vector<double> largest;
  for_each_bin(values.size(), per_bin, [&](std::size_t first, std::size_t last) {
    const auto begin = values.begin();
    largest.push_back(*std::max_element(begin + static_cast<std::ptrdiff_t>(first),
                                        begin + static_cast<std::ptrdiff_t>(last)));
  });
  return largest;
}

Table lengths_of(const VectorTable& table) {
  Table lengths;
  for (const std::vector<core::Vec3>& worlds : table) {
    std::vector<double>& row = lengths.emplace_back();
    for (const core::Vec3& vector : worlds) row.push_back(vector.norm());
  }
  return lengths;
}

std::string plots_json(const RunData& run, double budget_s) {
  const std::size_t num_frames = run.frame_wall_s.size();
  const std::size_t per_bin = std::max<std::size_t>(1, (num_frames + max_plot_points - 1) / max_plot_points);
  json plots;
  plots["num_frames"] = num_frames;
  plots["first_frame"] = integer_attribute_of(run, "first_frame", 0);
  plots["per_bin"] = per_bin;
  std::vector<double> wall_ms = largest_of_bins(run.frame_wall_s, per_bin);
  for (double& wall : wall_ms) wall *= 1e3;
  plots["wall_ms"] = wall_ms;
  plots["num_warmup"] =
      std::find(run.frame_measured.begin(), run.frame_measured.end(), true) - run.frame_measured.begin();
  plots["budget_ms"] = 1e3 * budget_s;
  plots["phases"] = phases_json(run);
  plots["hosts"] = run.hosts;
  plots["num_worlds"] = run.num_worlds;
  plots["num_ranks"] = run.num_ranks;
  plots["islands"] = band_json(run, "islands", per_bin);
  plots["contacts"] = band_json(run, "contacts", per_bin);
  constexpr double mm = 1e3;
  plots["energy"] = band_json(run, "energy", per_bin);
  plots["linear_momentum"] = length_json(run, "linear_momentum", per_bin);
  plots["angular_momentum"] = length_json(run, "angular_momentum", per_bin);
  plots["joint_gap_mm"] = band_json(run, "joint_gap", per_bin, mm);
  plots["max_penetration_mm"] = band_json(run, "max_penetration", per_bin, mm);
  return dump(plots);
}

}  // namespace pbmpi::io::html
