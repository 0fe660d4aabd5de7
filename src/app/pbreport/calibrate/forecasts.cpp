#include "app/pbreport/calibrate/forecasts.h"

#include <string>

#include "app/pbreport/tables/row_table.h"

namespace pbmpi::app {
namespace {

using analysis::FramePart;

constexpr std::int64_t last_power_of_ranks = 131072;
/// Measured frames of a run whose memory is forecast.
constexpr std::int64_t usual_frames = 1000;

Forecast forecast_of(const ForecastQuestion& question, const analysis::HarnessCosts& costs,
                     std::int64_t worlds, std::int64_t ranks, Way way) {
  Forecast forecast;
  forecast.load = {.num_ranks = static_cast<int>(ranks),
                   .num_worlds = worlds,
                   .bodies_each = question.bodies,
                   .step_s = question.step_s};
  forecast.way = way;
  const analysis::GatherShape shape =
      way == Way::tree ? analysis::GatherShape() : analysis::GatherShape::linear(forecast.load.num_ranks);
  forecast.traffic = analysis::frame_traffic(forecast.load, shape);
  forecast.frame = analysis::frame_forecast(forecast.load, costs, shape);
  forecast.memory = analysis::memory_forecast(
      forecast.load, costs, shape,
      way == Way::tree ? analysis::EndOfRun::on_root : analysis::EndOfRun::on_every_rank, usual_frames);
  forecast.within_budget = forecast.frame.total_s() <= question.budget_s;
  return forecast;
}

}  // namespace

std::vector<Forecast> forecasts_of(const ForecastQuestion& question, const analysis::HarnessCosts& costs) {
  std::vector<Forecast> forecasts;
  for (const std::int64_t worlds : question.worlds) {
    for (const std::int64_t ranks : question.ranks) {
      if (ranks > worlds) continue;
      for (const Way way : {Way::flat, Way::tree})
        forecasts.push_back(forecast_of(question, costs, worlds, ranks, way));
    }
  }
  return forecasts;
}

std::vector<Wall> walls_of(const ForecastQuestion& question, const analysis::HarnessCosts& costs) {
  std::vector<Wall> walls;
  for (const std::int64_t worlds : question.worlds) {
    for (std::size_t part = 1; part < analysis::frame_part_names.size(); ++part)
      walls.push_back({worlds, static_cast<FramePart>(part), 0, 0});
    Wall* const of_worlds = &walls[walls.size() - (analysis::frame_part_names.size() - 1)];
    for (std::int64_t ranks = 2; ranks <= std::min(last_power_of_ranks, worlds); ranks *= 2) {
      for (const Way way : {Way::flat, Way::tree}) {
        const Forecast forecast = forecast_of(question, costs, worlds, ranks, way);
        for (std::size_t part = 1; part < analysis::frame_part_names.size(); ++part) {
          std::int64_t& found =
              way == Way::flat ? of_worlds[part - 1].flat_ranks : of_worlds[part - 1].tree_ranks;
          if (found == 0 && forecast.frame[static_cast<FramePart>(part)] > question.budget_s) found = ranks;
        }
      }
    }
  }
  return walls;
}

std::vector<ForecastCheck> checks_of(const Calibration& calibration) {
  std::vector<ForecastCheck> checks;
  for (const analysis::TimedCase& one : calibration.cases) {
    if (one.part != analysis::TimedPart::frame || one.ranks == 1) continue;
    const analysis::HarnessLoad load{.num_ranks = static_cast<int>(one.ranks),
                                     .num_worlds = one.worlds,
                                     .bodies_each = one.bodies,
                                     .steps_per_frame = static_cast<int>(one.steps)};
    checks.push_back({one, analysis::frame_forecast(load, calibration.costs).total_s()});
  }
  return checks;
}

io::TableFile forecast_tables(const Calibration& calibration, const ForecastQuestion& question) {
  io::TableFile file;
  const std::vector<NamedCost> costs = named_costs(calibration.costs);
  RowTable<NamedCost> cost_table(costs);
  cost_table.add("cost", "", [](const NamedCost& cost) { return std::string(cost.name); });
  cost_table.add("value", "", [](const NamedCost& cost) { return cost.value; });
  cost_table.add("unit", "", [](const NamedCost& cost) { return std::string(cost.unit); });
  file.tables["costs"] = std::move(cost_table.columns);

  const std::vector<Forecast> forecasts = forecasts_of(question, calibration.costs);
  RowTable<Forecast> table(forecasts);
  table.add("worlds", "", [](const Forecast& f) { return f.load.num_worlds; });
  table.add("ranks", "", [](const Forecast& f) { return std::int64_t{f.load.num_ranks}; });
  table.add("gather", "",
            [](const Forecast& f) { return std::string(way_names[static_cast<std::size_t>(f.way)]); });
  table.add("messages", "", [](const Forecast& f) { return f.traffic.all().messages; });
  table.add("bytes", "B", [](const Forecast& f) { return f.traffic.all().bytes; });
  table.add("messages_into_root", "", [](const Forecast& f) { return f.traffic.into_root.messages; });
  table.add("bytes_into_root", "B", [](const Forecast& f) { return f.traffic.into_root.bytes; });
  table.add("bytes_of_busiest_rank", "B", [](const Forecast& f) { return f.traffic.busiest_rank.bytes; });
  for (std::size_t part = 0; part < analysis::frame_part_names.size(); ++part) {
    table.add(std::string(analysis::frame_part_names[part]) + "_time", "s",
              [part](const Forecast& f) { return f.frame.seconds[part]; });
  }
  table.add("frame_time", "s", [](const Forecast& f) { return f.frame.total_s(); });
  table.add("longest_part", "", [](const Forecast& f) {
    return std::string(analysis::frame_part_names[static_cast<std::size_t>(f.frame.wall())]);
  });
  table.add("within_budget", "", [](const Forecast& f) { return std::int64_t{f.within_budget ? 1 : 0}; });
  table.add("memory_any_rank", "B", [](const Forecast& f) { return f.memory.any_rank; });
  table.add("memory_root", "B", [](const Forecast& f) { return f.memory.root; });
  table.add("memory_row_writer", "B", [](const Forecast& f) { return f.memory.row_writer; });
  file.tables["forecasts"] = std::move(table.columns);

  const std::vector<Wall> walls = walls_of(question, calibration.costs);
  RowTable<Wall> wall_table(walls);
  wall_table.add("worlds", "", [](const Wall& w) { return w.worlds; });
  wall_table.add("part", "", [](const Wall& w) {
    return std::string(analysis::frame_part_names[static_cast<std::size_t>(w.part)]);
  });
  wall_table.add("flat_ranks", "", [](const Wall& w) { return w.flat_ranks; });
  wall_table.add("tree_ranks", "", [](const Wall& w) { return w.tree_ranks; });
  file.tables["walls"] = std::move(wall_table.columns);

  const std::vector<ForecastCheck> checks = checks_of(calibration);
  RowTable<ForecastCheck> check_table(checks);
  check_table.add("ranks", "", [](const ForecastCheck& c) { return c.measured.ranks; });
  check_table.add("worlds", "", [](const ForecastCheck& c) { return c.measured.worlds; });
  check_table.add("bodies", "", [](const ForecastCheck& c) { return c.measured.bodies; });
  check_table.add("steps", "", [](const ForecastCheck& c) { return c.measured.steps; });
  check_table.add("measured", "s", [](const ForecastCheck& c) { return c.measured.seconds; });
  check_table.add("forecast", "s", [](const ForecastCheck& c) { return c.forecast_s; });
  file.tables["checks"] = std::move(check_table.columns);
  return file;
}

}  // namespace pbmpi::app
