#include "app/pbreport/ensemble/ensemble_tables.h"

#include <algorithm>
#include <cstdlib>

#include "app/common/format.h"
#include "app/common/version.h"
#include "app/pbreport/tables/row_table.h"
#include "core/error.h"
#include "core/number_text.h"
#include "core/statistics.h"
#include "core/text.h"

namespace pbmpi::app {
namespace {

using Columns = std::vector<io::TableColumn>;

/// A table whose rows have a frame and spreads.
template <class Row>
class Table : public RowTable<Row> {
 public:
  using RowTable<Row>::RowTable;

  /// Adds the columns of a Spread: count, nonfinite, mean ...; without `prefix` under these names.
  template <class SpreadOf>
  void add_spread(const std::string& prefix, const std::string& unit, const std::vector<double>& quantiles,
                  SpreadOf&& spread_of_row) {
    this->add(prefix + "count", "", [&](const Row& row) { return spread_of_row(row).count; });
    this->add(prefix + "nonfinite", "", [&](const Row& row) { return spread_of_row(row).nonfinite; });
    this->add(prefix + "mean", unit, [&](const Row& row) { return spread_of_row(row).mean; });
    this->add(prefix + "stddev", unit, [&](const Row& row) { return spread_of_row(row).stddev; });
    this->add(prefix + "min", unit, [&](const Row& row) { return spread_of_row(row).min; });
    for (std::size_t q = 0; q < quantiles.size(); ++q)
      this->add(prefix + quantile_name(quantiles[q]), unit,
                [&](const Row& row) { return spread_of_row(row).quantiles[q]; });
    this->add(prefix + "max", unit, [&](const Row& row) { return spread_of_row(row).max; });
  }
  /// Adds the columns of a row's frame.
  template <class FrameOf>
  void add_frame(FrameOf&& frame_of) {
    this->add("frame", "", [&](const Row& row) { return frame_of(row).frame; });
    this->add("step", "", [&](const Row& row) { return frame_of(row).step; });
    this->add("time", "s", [&](const Row& row) { return frame_of(row).time_s; });
    this->add("measured", "", [&](const Row& row) { return std::int64_t{frame_of(row).is_measured}; });
  }
};

/// Wall times of the measured frames.
std::vector<double> measured_wall_s(const io::RunTables& run) {
  const io::RunTable* table = run.find("timings");
  core::require_input(table != nullptr, run.path() + ": it has no timings; was it written by pbmpi?");
  io::RunTable wall = *table;
  wall.columns = {"/timings/frame/wall"};
  const auto all = std::get<std::vector<double>>(run.read(wall, 0, run.num_rows(wall)).front().values);
  std::vector<double> measured;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (run.frames()[i].is_measured) measured.push_back(all[i]);
  }
  return measured;
}

Columns runs_table(const EnsembleRuns& ensemble) {
  struct Row {
    const io::RunTables* run;
    std::vector<double> wall_s;
  };
  std::vector<Row> rows;
  for (const io::RunTables& run : ensemble.runs()) rows.push_back({&run, measured_wall_s(run)});
  Table<Row> table(rows);
  const auto text = [](const char* name) {
    return [name](const Row& row) { return core::value_in(row.run->parameters(), name); };
  };
  table.add("file", "", [](const Row& row) { return row.run->path(); });
  table.add("seed", "", text("seed"));
  table.add("solver_seed", "", text("solver_seed"));
  table.add("state_hash", "",
            [](const Row& row) { return core::value_in(row.run->attributes(), "state_hash"); });
  table.add("complete", "", [](const Row& row) {
    return std::int64_t{core::value_in(row.run->attributes(), "complete") == "1"};
  });
  table.add("frames", "", [](const Row& row) { return static_cast<std::int64_t>(row.run->frames().size()); });
  table.add("ranks", "",
            [](const Row& row) { return static_cast<std::int64_t>(row.run->items().hosts.size()); });
  table.add("worlds", "", [](const Row& row) { return std::int64_t{row.run->items().num_worlds}; });
  table.add("frame_time_median", "s", [](const Row& row) { return core::quantile(row.wall_s, 0.5); });
  table.add("frame_time_max", "s", [](const Row& row) { return core::summarize(row.wall_s).max; });
  table.add("frame_rate", "Hz", [](const Row& row) {
    std::vector<double> rates;
    for (const double wall_s : row.wall_s) rates.push_back(1 / wall_s);
    return core::harmonic_mean(rates);
  });
  return table.columns;
}

Columns frames_table(const EnsembleRuns& ensemble, const std::vector<QuantitySpread>& quantities,
                     const std::vector<double>& quantiles) {
  struct Row {
    const io::FrameTime* frame;
    const QuantitySpread* quantity;
    const Spread* spread;
  };
  std::vector<Row> rows;
  for (std::size_t i = 0; i < static_cast<std::size_t>(ensemble.num_frames()); ++i) {
    for (const QuantitySpread& quantity : quantities)
      rows.push_back({&ensemble.first().frames()[i], &quantity, &quantity.by_frame[i]});
  }
  Table<Row> table(rows);
  table.add_frame([](const Row& row) -> const io::FrameTime& { return *row.frame; });
  table.add("quantity", "", [](const Row& row) { return row.quantity->name; });
  table.add("unit", "", [](const Row& row) { return row.quantity->unit; });
  table.add_spread("", "", quantiles, [](const Row& row) -> const Spread& { return *row.spread; });
  return table.columns;
}

Columns positions_table(const EnsembleRuns& ensemble, const std::vector<PositionSpread>& rows,
                        const std::vector<double>& quantiles) {
  Table<PositionSpread> table(rows);
  table.add_frame([&](const PositionSpread& row) -> const io::FrameTime& {
    return ensemble.first().frames()[row.frame];
  });
  table.add("distance_rms", "m", [](const PositionSpread& row) { return row.rms_m; });
  table.add_spread("body_rms_", "m", quantiles,
                   [](const PositionSpread& row) -> const Spread& { return row.of_bodies; });
  table.add("widest_body", "", [](const PositionSpread& row) { return row.widest; });
  table.add("widest_name", "", [&](const PositionSpread& row) {
    return row.widest < 0 ? std::string()
                          : ensemble.first().items().body_name[static_cast<std::size_t>(row.widest)];
  });
  return table.columns;
}

template <class Row>
void add_mean(Table<Row>& table, const std::string& prefix,
              const std::function<const BodySpread&(const Row&)>& of) {
  constexpr std::array axes = {"x", "y", "z"};
  for (int axis = 0; axis < 3; ++axis)
    table.add(prefix + "mean_" + axes[static_cast<std::size_t>(axis)], "m",
              [&, axis](const Row& row) { return of(row).mean[axis]; });
  table.add(prefix + "distance_rms", "m", [&](const Row& row) { return of(row).rms_m; });
}

Columns bodies_table(const EnsembleRuns& ensemble, const std::vector<BodySummary>& bodies) {
  struct Row {
    std::size_t body;
    const BodySummary* summary;
  };
  std::vector<Row> rows;
  for (std::size_t body = 0; body < bodies.size(); ++body) rows.push_back({body, &bodies[body]});
  const io::RunItems& items = ensemble.first().items();
  Table<Row> table(rows);
  table.add("body", "", [](const Row& row) { return static_cast<std::int64_t>(row.body); });
  table.add("world", "", [&](const Row& row) {
    return ensemble.over() == SampleOf::runs ? items.body_world[row.body] : std::int64_t{-1};
  });
  table.add("name", "", [&](const Row& row) { return items.body_name[row.body]; });
  table.add("actor", "", [&](const Row& row) { return items.actor[row.body]; });
  table.add("kind", "", [&](const Row& row) { return items.actor_kind[row.body]; });
  table.add("distance_rms", "m", [](const Row& row) { return row.summary->rms_m; });
  table.add("distance_max", "m", [](const Row& row) { return row.summary->max_m; });
  table.add("nonfinite", "", [](const Row& row) { return row.summary->nonfinite; });
  add_mean<Row>(table, "last_", [](const Row& row) -> const BodySpread& { return row.summary->last; });
  return table.columns;
}

Columns body_frames_table(const EnsembleRuns& ensemble, const std::vector<PositionSpread>& frames,
                          const std::vector<double>& quantiles) {
  struct Row {
    std::size_t frame;
    std::int64_t body;
    const BodySpread* spread;
  };
  std::vector<Row> rows;
  for (const PositionSpread& frame : frames) {
    for (std::size_t body = 0; body < frame.bodies.size(); ++body)
      rows.push_back({frame.frame, static_cast<std::int64_t>(body), &frame.bodies[body]});
  }
  Table<Row> table(rows);
  table.add_frame(
      [&](const Row& row) -> const io::FrameTime& { return ensemble.first().frames()[row.frame]; });
  table.add("body", "", [](const Row& row) { return row.body; });
  add_mean<Row>(table, "", [](const Row& row) -> const BodySpread& { return *row.spread; });
  table.add_spread("distance_", "m", quantiles,
                   [](const Row& row) -> const Spread& { return row.spread->distance; });
  return table.columns;
}

Columns worlds_table(const std::vector<WorldFacts>& worlds) {
  Table<WorldFacts> table(worlds);
  table.add("run", "", [](const WorldFacts& w) { return static_cast<std::int64_t>(w.run); });
  table.add("world", "", [](const WorldFacts& w) { return std::int64_t{w.world}; });
  const auto add = [&table](const char* name, const char* unit, double WorldFacts::*fact) {
    table.add(name, unit, [fact](const WorldFacts& w) { return w.*fact; });
  };
  add("contacts_mean", "", &WorldFacts::contacts_mean);
  add("contacts_max", "", &WorldFacts::contacts_max);
  add("rows_mean", "", &WorldFacts::rows_mean);
  add("rows_max", "", &WorldFacts::rows_max);
  add("islands_mean", "", &WorldFacts::islands_mean);
  add("energy_first", "J", &WorldFacts::energy_first_j);
  add("energy_last", "J", &WorldFacts::energy_last_j);
  add("penetration_max", "m", &WorldFacts::penetration_max_m);
  add("joint_gap_max", "m", &WorldFacts::joint_gap_max_m);
  add("collide_mean", "s", &WorldFacts::collide_s);
  add("solve_mean", "s", &WorldFacts::solve_s);
  return table.columns;
}

/// Adds columns that a run has once, one row per world: those in `names`, or all; only columns that all runs
/// have.
void append_once(const EnsembleRuns& ensemble, const char* table_name, const std::vector<std::string>& names,
                 Columns& columns) {
  std::vector<Columns> parts;
  for (const io::RunTables& run : ensemble.runs()) {
    const io::RunTable* table = run.find(table_name);
    if (table == nullptr) return;
    parts.push_back(run.read(*table, 0, 1));
  }
  for (io::TableColumn joined : parts.front()) {
    const bool wanted = names.empty() || std::ranges::find(names, joined.name) != names.end();
    if (!wanted || joined.name == "id") continue;
    bool all_have_it = true;
    for (auto part = parts.begin() + 1; part != parts.end(); ++part) {
      const auto found = std::ranges::find(*part, joined.name, &io::TableColumn::name);
      all_have_it = all_have_it && found != part->end() && found->values.index() == joined.values.index();
      if (!all_have_it) break;
      std::visit(
          [&](auto& values) {
            const auto& more = std::get<std::decay_t<decltype(values)>>(found->values);
            values.insert(values.end(), more.begin(), more.end());
          },
          joined.values);
    }
    if (all_have_it) columns.push_back(std::move(joined));
  }
}

}  // namespace

std::string quantile_name(double quantile) { return format("q%g", 100 * quantile); }

io::TableFile ensemble_tables(const EnsembleRuns& runs, const Ensemble& found,
                              const EnsembleOptions& options) {
  io::TableFile file;
  file.attributes = {{"pbmpi_version", program_version}, {"git_revision", git_revision}};
  std::string differences;
  for (const std::string& one : runs.differences()) differences += one + "\n";
  file.parameters = {io::Parameter::of("scene", core::value_in(runs.first().attributes(), "scene")),
                     io::Parameter::of("over", options.over == SampleOf::runs ? "runs" : "worlds"),
                     io::Parameter::of("differences", differences)};
  file.tables["runs"] = runs_table(runs);
  file.tables["frames"] = frames_table(runs, found.quantities, options.quantiles);
  file.tables["positions"] = positions_table(runs, found.positions.frames, options.quantiles);
  file.tables["bodies"] = bodies_table(runs, found.positions.bodies);
  Columns& worlds = file.tables["worlds"] = worlds_table(found.worlds);
  append_once(runs, "world_results", {"survived", "nonfinite_step", "row_visits", "cost"}, worlds);
  append_once(runs, "world_parameters", {}, worlds);
  if (options.by_body)
    file.tables["body_frames"] = body_frames_table(runs, found.positions.frames, options.quantiles);
  return file;
}

}  // namespace pbmpi::app
