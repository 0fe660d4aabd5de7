#include "app/pbreport/calibrate/forecast_text.h"

#include <cmath>

#include "app/common/format.h"
#include "app/pbreport/tables/text_cells.h"

namespace pbmpi::app {
namespace {

using Rows = std::vector<std::vector<std::string>>;

std::string time_text(double seconds) {
  if (seconds >= 1) return format("%.3g s", seconds);
  if (seconds >= 1e-3) return format("%.3g ms", 1e3 * seconds);
  return seconds >= 1e-6 ? format("%.3g us", 1e6 * seconds) : format("%.3g ns", 1e9 * seconds);
}

std::string bytes_text(double bytes) {
  static constexpr const char* units[] = {"B", "kB", "MB", "GB", "TB"};
  int unit = 0;
  for (; bytes >= 1000 && unit < 4; ++unit) bytes /= 1000;
  return format("%.3g %s", bytes, units[unit]);
}

std::string part_text(analysis::FramePart part) {
  return std::string(analysis::frame_part_names[static_cast<std::size_t>(part)]);
}

Rows cost_rows(const analysis::HarnessCosts& costs) {
  Rows rows = {{"cost", "value"}};
  for (const NamedCost& cost : named_costs(costs))
    rows.push_back({cost.name, cost.unit[0] == 's' ? time_text(cost.value) : bytes_text(cost.value)});
  return rows;
}

Rows forecast_rows(const std::vector<Forecast>& forecasts) {
  Rows rows = {{"worlds", "ranks", "gather", "messages into root", "bytes into root", "busiest rank", "frame",
                "gather", "memory of a rank", "of root", "longest part"}};
  for (const Forecast& one : forecasts) {
    rows.push_back({std::to_string(one.load.num_worlds), std::to_string(one.load.num_ranks),
                    std::string(way_names[static_cast<std::size_t>(one.way)]),
                    std::to_string(one.traffic.into_root.messages),
                    bytes_text(static_cast<double>(one.traffic.into_root.bytes)),
                    bytes_text(static_cast<double>(one.traffic.busiest_rank.bytes)),
                    time_text(one.frame.total_s()), time_text(one.frame[analysis::FramePart::gather]),
                    bytes_text(one.memory.any_rank), bytes_text(one.memory.root),
                    part_text(one.frame.wall()) + (one.within_budget ? "" : ", over the budget")});
  }
  return rows;
}

std::string wall_text(std::int64_t ranks) { return ranks == 0 ? "none" : std::to_string(ranks); }

Rows wall_rows(const std::vector<Wall>& walls) {
  Rows rows = {{"worlds", "part", "flat: from ranks", "tree: from ranks"}};
  for (const Wall& wall : walls) {
    if (wall.flat_ranks == 0 && wall.tree_ranks == 0) continue;
    rows.push_back({std::to_string(wall.worlds), part_text(wall.part), wall_text(wall.flat_ranks),
                    wall_text(wall.tree_ranks)});
  }
  return rows;
}

Rows check_rows(const std::vector<ForecastCheck>& checks) {
  Rows rows = {{"ranks", "worlds", "bodies", "steps", "measured", "forecast", "forecast / measured"}};
  for (const ForecastCheck& check : checks) {
    rows.push_back({std::to_string(check.measured.ranks), std::to_string(check.measured.worlds),
                    std::to_string(check.measured.bodies), std::to_string(check.measured.steps),
                    time_text(check.measured.seconds), time_text(check.forecast_s),
                    format("%.2f", check.forecast_s / check.measured.seconds)});
  }
  return rows;
}

}  // namespace

std::string forecast_text(const Calibration& calibration, const ForecastQuestion& question,
                          bool as_markdown) {
  const auto table = [&](const Rows& rows) {
    if (rows.size() == 1) return std::string("none\n");
    return as_markdown ? markdown(rows) : aligned(rows);
  };
  const std::string gap = as_markdown ? "\n\n" : "\n";
  std::string text = "Costs of the harness, measured:" + gap + table(cost_rows(calibration.costs));
  text += format("\nForecast of a frame, worlds of %lld bodies that take %s a step, budget %s:",
                 static_cast<long long>(question.bodies), time_text(question.step_s).c_str(),
                 time_text(question.budget_s).c_str()) +
          gap + table(forecast_rows(forecasts_of(question, calibration.costs)));
  text += "\nFrom how many ranks on a part alone takes longer than the budget:" + gap +
          table(wall_rows(walls_of(question, calibration.costs)));
  text += "\nFrames of the ranks that there were, measured and forecast:" + gap +
          table(check_rows(checks_of(calibration)));
  return text;
}

}  // namespace pbmpi::app
