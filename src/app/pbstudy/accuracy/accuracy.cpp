#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include "app/pbstudy/accuracy/accuracy_cases.h"
#include "app/pbstudy/accuracy/case_runner.h"
#include "app/pbstudy/accuracy/nature.h"
#include "app/pbstudy/accuracy/own_solution.h"
#include "app/pbstudy/study/engine_differences.h"
#include "app/pbstudy/study/study_runner.h"
#include "app/pbstudy/study/table_columns.h"
#include "core/statistics.h"
#include "io/table/table_file.h"

namespace pbmpi::app {
namespace {

/// A measured frame: how far both ways went, and what is known.
struct NatureFrameRow {
  int case_index = 0;
  int frame = 0;
  std::array<int, 2> steps{};  ///< of the frame, by Way
  /// What half as many steps change of the positions [m], by Way; and how far apart the ways are.
  std::array<double, 2> halved_median_m{}, halved_p90_m{};
  double apart_median_m = 0, apart_p90_m = 0;
  std::array<double, asked_m.size()> determined{};  ///< shares of the bodies
};

/// A body at the end of a measured frame.
struct NatureBodyRow {
  int case_index = 0;
  int frame = 0, world = 0, body = 0;
  /// Positions [m], world frame: soft with half as many steps, soft, ode with half as many, ode.
  std::array<std::array<double, 3>, 4> ends{};
  double uncertainty_m = 0;
};

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

/// The two tables by name.
std::map<std::string, std::vector<io::TableColumn>> nature_tables(const std::vector<StudyScene>& scenes,
                                                                  const std::vector<AccuracyCase>& cases,
                                                                  const std::vector<NatureFrameRow>& frames,
                                                                  const std::vector<NatureBodyRow>& bodies) {
  return {{"nature", frame_columns(scene_of(scenes, cases, frames), frames)},
          {"nature_bodies", body_columns(scene_of(scenes, cases, bodies), bodies)}};
}

using io::Parameter;

using AccuracyOutcomes = CaseOutcomes<CaseResult, NatureFrameRow, NatureBodyRow>;

/// Each rank that has cases of a scene finds the scene's nature and own solutions itself.
AccuracyOutcomes run_cases(const AccuracyOptions& options, const std::vector<AccuracyCase>& cases,
                           StudyRunner& runner) {
  std::optional<Nature> nature;
  std::optional<RestRunner> rest;
  std::optional<OwnSolutions> own;
  int scene_of_nature = -1;
  const auto cost = [&](const AccuracyCase& one) { return cost_of(one, runner.scene(one.scene)); };
  const auto run_one = [&](std::size_t i) -> CaseOutcome<CaseResult, NatureFrameRow, NatureBodyRow> {
    const AccuracyCase& one = cases[i];
    const StudyScene& scene = runner.scene(one.scene);
    if (one.scene != scene_of_nature) {
      nature = find_nature(scene, options.nature, [&](int frame, int steps) {
        runner.show_progress(fmt::format("{}: nature, frame {} of {}, {} steps", scene.source.name, frame + 1,
                                         scene.total_frames(), steps));
      });
      rest.emplace(scene, resting_settings(scene, options.nature), options.rest_s);
      own.emplace(scene, *nature, cases, options);
      scene_of_nature = one.scene;
    }
    if (one.kind == CaseKind::nature) return {account_of(*nature), {frame_rows(*nature), body_rows(*nature)}};
    if (is_own(one.kind)) return {own->judge(static_cast<int>(i))};
    return {run_case(one, scene, *nature, *rest, options.repeats, own->ends(one.own))};
  };
  return runner.run<CaseResult, NatureFrameRow, NatureBodyRow>(cases, cost, run_one);
}

/// Columns with one row per case (io/SCHEMA.md). `results` [num_cases] in the order of the cases.
std::vector<io::TableColumn> case_columns(const std::vector<StudyScene>& scenes,
                                          const std::vector<AccuracyCase>& cases,
                                          const std::vector<CaseResult>& results) {
  using Case = const AccuracyCase&;
  using Result = const CaseResult&;
  std::vector<io::TableColumn> columns = {
      scene_column("scene", scenes, cases, &StudyScene::name),
      column("kind", "", cases, [](Case c) { return case_kind_names[static_cast<std::size_t>(c.kind)]; }),
      column("estimate_iterations", "", cases,
             [](Case c) { return c.estimate ? c.estimate->iterations : 0; }),
      column("own", "", cases, &AccuracyCase::own),
      column("steps_per_frame", "", cases, &AccuracyCase::steps_per_frame),
      scene_column("worlds", scenes, cases, &StudyScene::num_worlds),
      scene_column("warmup", scenes, cases, &StudyScene::warmup),
      scene_column("frames", scenes, cases, &StudyScene::frames),
      column("frame_time_median", "s", results, &CaseResult::frame_time_median_s),
      column("frame_time_worst", "s", results, &CaseResult::frame_time_worst_s),
      column("frame_time_p10", "s", results, &CaseResult::frame_time_p10_s),
      column("frame_time_p90", "s", results, &CaseResult::frame_time_p90_s),
      column("rows", "", results, &CaseResult::rows),
      column("row_visits", "", results, &CaseResult::row_visits),
      column("joint_gap", "m", results, &CaseResult::max_joint_gap_m),
      column("penetration", "m", results, &CaseResult::max_penetration_m),
      column("energy_change", "J", results, &CaseResult::energy_change_j),
      column("solve_iterations", "", results, &CaseResult::solve_iterations),
      wide_column("determined", "", results, &CaseResult::determined),
      wide_column("within", "", results, &CaseResult::within),
      column("rest_fallen", "", results, [](Result r) { return r.rest.fallen; }),
      column("rest_fell_at", "s", results, [](Result r) { return r.rest.fell_at_s; }),
      column("rest_creep", "m/s", results, [](Result r) { return r.rest.creep_m_s; }),
      column("rest_energy_gain", "J", results, [](Result r) { return r.rest.energy_gain_j; }),
  };
  add_step_columns(cases, columns);
  add_errors("defect", &CaseResult::defect, results, columns);
  add_errors("own_defect", &CaseResult::own_defect, results, columns);
  add_errors("drift", &CaseResult::drift, results, columns);
  return columns;
}

StudyContent content(const AccuracyOptions& options, const std::vector<StudyScene>& scenes,
                     const std::vector<AccuracyCase>& cases, const AccuracyOutcomes& outcomes) {
  StudyContent content;
  content.parameters = {Parameter::of("nature_steps", std::int64_t{options.nature.most_steps}),
                        Parameter::of("nature_error", options.nature.error_m),
                        Parameter::of("own_iterations", std::int64_t{options.own_iterations}),
                        Parameter::of("own_most_iterations", std::int64_t{options.own_most_iterations}),
                        Parameter::of("rest_seconds", options.rest_s)};
  content.cases = case_columns(scenes, cases, outcomes.results);
  content.tables =
      nature_tables(scenes, cases, outcomes.rows_of<NatureFrameRow>(), outcomes.rows_of<NatureBodyRow>());
  std::vector<SceneModel> models;
  models.reserve(scenes.size());
  for (const StudyScene& scene : scenes)
    models.push_back({scene.source.name, scenes::parse_scene(scene.source)->build(0, options.seed)});
  content.tables["differences"] = engine_differences(models, steppers_of(cases));
  content.next = " --budget 3.33ms";
  return content;
}

}  // namespace

core::ExitCode run_accuracy(const mpi::Communicator& comm, const std::vector<std::string>& args) {
  const AccuracyOptions options = parse_accuracy_options(args);
  StudyRunner runner(comm, "accuracy", options);
  const std::vector<AccuracyCase> cases = make_cases(runner.scenes(), options);
  runner.open_output();
  const AccuracyOutcomes outcomes = run_cases(options, cases, runner);
  runner.write([&] { return content(options, runner.scenes(), cases, outcomes); });
  return core::ExitCode::done;
}

}  // namespace pbmpi::app
