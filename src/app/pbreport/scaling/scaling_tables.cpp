#include "app/pbreport/scaling/scaling_tables.h"

#include "app/common/version.h"
#include "app/pbreport/scaling/scaling_text.h"
#include "app/pbreport/tables/row_table.h"
#include "core/clock.h"
#include "core/statistics.h"

namespace pbmpi::app {
namespace {

using Columns = std::vector<io::TableColumn>;

struct PointRow {
  std::int64_t curve;
  const ScalingCurve* of;
  const ScalingPoint* point;
};

std::vector<PointRow> rows_of(const std::vector<ScalingCurve>& curves) {
  std::vector<PointRow> rows;
  for (std::size_t i = 0; i < curves.size(); ++i) {
    for (const ScalingPoint& point : curves[i].points)
      rows.push_back({static_cast<std::int64_t>(i), &curves[i], &point});
  }
  return rows;
}

/// Adds columns that identify the point; `row_of`: the PointRow of a row.
template <class Row, class RowOf>
void add_point(RowTable<Row>& table, const RowOf& row_of) {
  table.add("curve", "", [&](const Row& row) { return row_of(row).curve; });
  table.add("kind", "", [&](const Row& row) { return name_of(row_of(row).of->kind); });
  table.add("scene", "", [&](const Row& row) { return row_of(row).of->first->scene; });
  table.add("stepper", "", [&](const Row& row) { return row_of(row).of->first->stepper; });
  table.add("precision", "", [&](const Row& row) { return row_of(row).of->first->precision; });
  table.add("decomposition", "", [&](const Row& row) { return row_of(row).point->decomposition; });
  table.add("ranks", "", [&](const Row& row) { return std::int64_t{row_of(row).point->ranks}; });
  table.add("worlds", "", [&](const Row& row) { return std::int64_t{row_of(row).point->worlds}; });
}

void add_estimated(RowTable<PointRow>& table, const std::string& name, Estimated ScalingPoint::*value) {
  table.add(name, "", [=](const PointRow& row) { return (row.point->*value).median; });
  table.add(name + "_low", "", [=](const PointRow& row) { return (row.point->*value).interval.low; });
  table.add(name + "_high", "", [=](const PointRow& row) { return (row.point->*value).interval.high; });
}

Columns points_table(const std::vector<PointRow>& rows) {
  RowTable<PointRow> table(rows);
  add_point(table, [](const PointRow& row) -> const PointRow& { return row; });
  const auto add = [&table](const char* name, const char* unit, auto value) {
    table.add(name, unit, [value](const PointRow& row) { return row.point->median_of(value); });
  };
  table.add("is_base", "",
            [](const PointRow& row) { return std::int64_t{row.point == &row.of->points[row.of->base]}; });
  table.add("repeats", "",
            [](const PointRow& row) { return static_cast<std::int64_t>(row.point->runs.size()); });
  add("frame_time", "s", &ScalingRun::frame_s);
  add_estimated(table, "speed_up", &ScalingPoint::speed_up);
  add_estimated(table, "efficiency", &ScalingPoint::efficiency);
  table.add("confidence", "", [](const PointRow& row) { return row.point->speed_up.interval.confidence; });
  table.add("ideal_speed_up", "", [](const PointRow& row) { return ideal_speed_up(*row.of, *row.point); });
  add("island_bound", "", &ScalingRun::island_bound);
  table.add("figure6_islands", "",
            [](const PointRow& row) { return row.of->figure6.value_or(Figure6Bars{}).islands; });
  table.add("figure6_spaces", "",
            [](const PointRow& row) { return row.of->figure6.value_or(Figure6Bars{}).spaces; });
  add("load_balance", "", &PopEfficiencies::load_balance);
  add("serialisation", "", &PopEfficiencies::serialisation);
  add("transfer", "", &PopEfficiencies::transfer);
  table.add("computation", "", [](const PointRow& row) { return row.point->computation; });
  add("root_share", "", &ScalingRun::root_share);
  add("messages", "", &ScalingRun::messages);
  add("bytes", "B", &ScalingRun::bytes);
  add("within_budget", "", &ScalingRun::within_budget);
  table.add("reportable", "", [](const PointRow& row) { return std::int64_t{row.point->doubts.empty()}; });
  table.add("doubts", "", [](const PointRow& row) { return doubts_text(*row.point); });
  return table.columns;
}

Columns phases_table(const std::vector<PointRow>& points) {
  struct Row {
    const PointRow* point;
    std::string phase;
    double seconds;
  };
  std::vector<Row> rows;
  for (const PointRow& point : points) {
    for (const std::string_view phase : core::phase_names)
      rows.push_back({&point, std::string(phase), phase_s(*point.point, std::string(phase))});
  }
  RowTable<Row> table(rows);
  add_point(table, [](const Row& row) -> const PointRow& { return *row.point; });
  table.add("phase", "", [](const Row& row) { return row.phase; });
  table.add("time", "s", [](const Row& row) { return row.seconds; });
  return table.columns;
}

Columns runs_table(const std::vector<PointRow>& points) {
  struct Row {
    const PointRow* point;
    const ScalingRun* run;
  };
  std::vector<Row> rows;
  for (const PointRow& point : points) {
    for (const ScalingRun* run : point.point->runs) rows.push_back({&point, run});
  }
  RowTable<Row> table(rows);
  add_point(table, [](const Row& row) -> const PointRow& { return *row.point; });
  table.add("file", "", [](const Row& row) { return row.run->path; });
  table.add("created", "", [](const Row& row) { return row.run->created; });
  table.add("frames", "", [](const Row& row) { return row.run->frames; });
  table.add("frame_time", "s", [](const Row& row) { return row.run->frame_s; });
  table.add("state_hash", "", [](const Row& row) { return row.run->state_hash; });
  table.add("complete", "", [](const Row& row) { return std::int64_t{row.run->complete}; });
  return table.columns;
}

}  // namespace

io::TableFile scaling_tables(const std::vector<ScalingCurve>& curves) {
  const std::vector<PointRow> rows = rows_of(curves);
  io::TableFile file;
  file.attributes = {{"pbmpi_version", program_version}, {"git_revision", git_revision}};
  file.tables["points"] = points_table(rows);
  file.tables["phases"] = phases_table(rows);
  file.tables["runs"] = runs_table(rows);
  return file;
}

}  // namespace pbmpi::app
