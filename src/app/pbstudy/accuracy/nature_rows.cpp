#include "app/pbstudy/accuracy/nature_rows.h"

#include <algorithm>
#include <utility>

#include "app/pbstudy/study/table_columns.h"
#include "core/statistics.h"

namespace pbmpi::app {
namespace {

constexpr std::array<const char*, 4> end_names = {"soft_halved", "soft", "ode_halved", "ode"};

/// The name of the scene of each row.
template <class Row>
io::TableColumn scene_of(const std::vector<StudyScene>& scenes, const std::vector<AccuracyCase>& cases,
                         const std::vector<Row>& rows) {
  return column("scene", "", rows, [&](const Row& row) {
    const AccuracyCase& one = cases[static_cast<std::size_t>(row.case_index)];
    return scenes[static_cast<std::size_t>(one.scene)].name();
  });
}

std::vector<io::TableColumn> frame_columns(io::TableColumn scene, const std::vector<NatureFrameRow>& rows) {
  using Row = const NatureFrameRow&;
  std::vector<io::TableColumn> columns = {std::move(scene),
                                          column("frame", "", rows, &NatureFrameRow::frame)};
  for (std::size_t way = 0; way < way_names.size(); ++way) {
    const std::string name(way_names[way]);
    columns.push_back(column(name + "_steps", "", rows, [way](Row row) { return row.steps[way]; }));
    columns.push_back(
        column(name + "_halved_median", "m", rows, [way](Row row) { return row.halved_median_m[way]; }));
    columns.push_back(
        column(name + "_halved_p90", "m", rows, [way](Row row) { return row.halved_p90_m[way]; }));
  }
  columns.push_back(column("apart_median", "m", rows, &NatureFrameRow::apart_median_m));
  columns.push_back(column("apart_p90", "m", rows, &NatureFrameRow::apart_p90_m));
  columns.push_back(wide_column("determined", "", rows, &NatureFrameRow::determined));
  return columns;
}

std::vector<io::TableColumn> body_columns(io::TableColumn scene, const std::vector<NatureBodyRow>& rows) {
  std::vector<io::TableColumn> columns = {std::move(scene), column("frame", "", rows, &NatureBodyRow::frame),
                                          column("world", "", rows, &NatureBodyRow::world),
                                          column("body", "", rows, &NatureBodyRow::body)};
  for (std::size_t end = 0; end < end_names.size(); ++end)
    columns.push_back(
        wide_column(end_names[end], "m", rows, [end](const NatureBodyRow& row) { return row.ends[end]; }));
  columns.push_back(column("uncertainty", "m", rows, &NatureBodyRow::uncertainty_m));
  return columns;
}

}  // namespace

std::vector<NatureFrameRow> frame_rows(const Nature& nature) {
  std::vector<NatureFrameRow> rows;
  for (const NatureFrame& frame : nature.frames) {
    NatureFrameRow row;
    row.frame = nature.first_frame() + static_cast<int>(rows.size());
    for (std::size_t way = 0; way < frame.ways.size(); ++way) {
      const std::vector<double> moved = distances_m(frame.ways[way].coarser, frame.ways[way].finer);
      row.steps[way] = frame.ways[way].steps;
      row.halved_median_m[way] = core::quantile(moved, 0.5);
      row.halved_p90_m[way] = core::quantile(moved, 0.9);
    }
    const std::vector<double> apart = distances_m(frame.by(Way::soft).finer, frame.by(Way::ode).finer);
    row.apart_median_m = core::quantile(apart, 0.5);
    row.apart_p90_m = core::quantile(apart, 0.9);
    WithinCounts counts;
    for (const analysis::PoseErrors& world : frame.uncertainty) counts.count(world, world);
    row.determined = counts.determined_shares();
    rows.push_back(row);
  }
  return rows;
}

std::vector<NatureBodyRow> body_rows(const Nature& nature) {
  std::vector<NatureBodyRow> rows;
  for (std::size_t frame = 0; frame < nature.frames.size(); ++frame) {
    const NatureFrame& found = nature.frames[frame];
    const WayEnds &soft = found.by(Way::soft), &ode = found.by(Way::ode);
    for (std::size_t world = 0; world < nature.worlds.size(); ++world) {
      for (std::size_t body = 0; body < soft.finer[world].position.size(); ++body) {
        NatureBodyRow row{0,
                          nature.first_frame() + static_cast<int>(frame),
                          static_cast<int>(world),
                          static_cast<int>(body),
                          {},
                          found.uncertainty[world].body_position_m[body]};
        auto* next = row.ends.begin();
        for (const States* ends : {&soft.coarser, &soft.finer, &ode.coarser, &ode.finer})
          std::copy_n((*ends)[world].position[body].data(), 3, (next++)->begin());
        rows.push_back(row);
      }
    }
  }
  return rows;
}

std::map<std::string, std::vector<io::TableColumn>> nature_tables(const std::vector<StudyScene>& scenes,
                                                                  const std::vector<AccuracyCase>& cases,
                                                                  const std::vector<NatureFrameRow>& frames,
                                                                  const std::vector<NatureBodyRow>& bodies) {
  return {{"nature", frame_columns(scene_of(scenes, cases, frames), frames)},
          {"nature_bodies", body_columns(scene_of(scenes, cases, bodies), bodies)}};
}

}  // namespace pbmpi::app
