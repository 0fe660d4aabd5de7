#include <map>
#include <set>
#include <string>
#include <vector>

#include <fmt/core.h>

#include "analysis/error_bands.h"
#include "app/pbstudy/stability/stability_runner.h"
#include "app/pbstudy/study/engine_differences.h"
#include "app/pbstudy/study/study_runner.h"
#include "app/pbstudy/study/table_columns.h"
#include "io/table/table_file.h"
#include "model/names.h"
#include "stability/cases/verdict.h"

namespace pbmpi::app {
namespace {

/// The data for the file's columns; all [num_cases], in the order of the cases.
struct StabilityRows {
  const std::vector<StudyScene>& scenes;
  const std::vector<StabilitySetting>& settings;
  const std::vector<stability::HardCase>& hard_cases;  ///< [num_scenes]
  const std::vector<StabilityCase>& cases;
  const std::vector<StabilityResult>& results;
};

using stability::Judgement;
using stability::Metric;
using stability::Verdict;

std::vector<Judgement> judge_all(const StabilityRows& rows) {
  std::vector<Judgement> judgements;
  for (std::size_t i = 0; i < rows.cases.size(); ++i) {
    const stability::HardCase& hard = rows.hard_cases[static_cast<std::size_t>(rows.cases[i].scene)];
    if (rows.cases[i].not_applicable.empty()) {
      judgements.push_back(judge(hard, rows.results[i].measurement(hard)));
    } else {
      judgements.push_back({Verdict::not_applicable, rows.cases[i].not_applicable, NAN, {NAN, NAN}, ""});
    }
  }
  return judgements;
}

std::vector<io::TableColumn> case_facts(const StabilityRows& rows) {
  using Case = const StabilityCase&;
  const auto hard = [&](Case c) -> const stability::HardCase& {
    return rows.hard_cases[static_cast<std::size_t>(c.scene)];
  };
  const auto& cases = rows.cases;
  std::vector<io::TableColumn> columns = {
      scene_column("scene", rows.scenes, cases, &StudyScene::name),
      column("group", "", cases, [&](Case c) { return hard(c).group; }),
      column("row", "", cases, [&](Case c) { return hard(c).row; }),
      column("oracle", "", cases, [&](Case c) { return hard(c).oracle; }),
      column("source", "", cases, [&](Case c) { return hard(c).source; }),
      column("setting", "", cases,
             [&](Case c) { return setting_text(rows.settings[static_cast<std::size_t>(c.setting)]); }),
      column("cut", "", cases, &StabilityCase::cut),
      column("bodies", "", cases, &StabilityCase::num_bodies),
      column("seconds", "s", cases, [&](Case c) { return hard(c).seconds; }),
  };
  add_step_columns(cases, columns);
  return columns;
}

/// Columns with one row per case (io/SCHEMA.md).
std::vector<io::TableColumn> stability_columns(const StabilityRows& rows) {
  using Result = const StabilityResult&;
  std::vector<io::TableColumn> columns = case_facts(rows);
  const std::vector<Judgement> judgements = judge_all(rows);
  using Judged = const Judgement&;
  columns.push_back(column("verdict", "", judgements, [](Judged j) {
    return std::string(stability::verdict_names[static_cast<std::size_t>(j.verdict)]);
  }));
  columns.push_back(column("decided_by", "", judgements, &Judgement::decided_by));
  columns.push_back(column("value", "", judgements, &Judgement::value));
  columns.push_back(column("value_unit", "", judgements, &Judgement::unit));
  columns.push_back(column("limit_right", "", judgements, [](Judged j) { return j.limits.right; }));
  columns.push_back(column("limit_broken", "", judgements, [](Judged j) { return j.limits.broken; }));
  const auto& results = rows.results;
  columns.push_back(column("broken_at", "s", results, &StabilityResult::broken_at_s));
  columns.push_back(column("simulated", "s", results, &StabilityResult::simulated_s));
  for (std::size_t m = 0; m < stability::num_metrics; ++m) {
    const stability::MetricTraits& traits = stability::metric_table[m];
    columns.push_back(column(std::string(traits.name), std::string(traits.unit), results,
                             [m](Result r) { return r.metrics[m]; }));
  }
  // The paper's category for the body that drifted farthest.
  columns.push_back(column("drift_band", "", results, [](Result r) {
    return analysis::position_band(r.metrics[static_cast<std::size_t>(Metric::drift)]);
  }));
  columns.push_back(column("row_visits", "", results, &StabilityResult::row_visits));
  columns.push_back(column("step_time", "s", results, &StabilityResult::step_time_s));
  return columns;
}

/// Tables "curves" and "poses".
std::map<std::string, std::vector<io::TableColumn>> stability_tables(const std::vector<CurvePoint>& points,
                                                                     const std::vector<RecordedPose>& poses) {
  std::vector<io::TableColumn> curves = {column("case", "", points, &CurvePoint::case_index),
                                         column("time", "s", points, &CurvePoint::time_s),
                                         column("energy", "J", points, &CurvePoint::energy_j),
                                         column("joint_gap", "m", points, &CurvePoint::joint_gap_m),
                                         column("penetration", "m", points, &CurvePoint::penetration_m),
                                         column("drift", "m", points, &CurvePoint::drift_m)};
  std::vector<io::TableColumn> replay = {
      column("case", "", poses, &RecordedPose::case_index), column("time", "s", poses, &RecordedPose::time_s),
      column("body", "", poses, &RecordedPose::body), wide_column("pose", "", poses, &RecordedPose::pose)};
  return {{"curves", std::move(curves)}, {"poses", std::move(replay)}};
}

struct BodyOfScene {
  const SceneModel& scene;
  const model::Body& body;
};

struct GeomOfScene {
  const SceneModel& scene;
  const model::Geom& geom;

  std::string kind() const {
    return std::string(name_of(scene.model->actors[static_cast<std::size_t>(geom.actor)].kind));
  }
};

/// Position [m], orientation (w, x, y, z).
void append(const model::Pose& pose, std::vector<double>& numbers) {
  const model::Vec3& at = pose.position;
  const model::Quat& turn = pose.orientation;
  numbers.insert(numbers.end(), {at.x(), at.y(), at.z(), turn.w, turn.x, turn.y, turn.z});
}

std::vector<io::TableColumn> body_columns(const std::vector<BodyOfScene>& bodies) {
  using Row = const BodyOfScene&;
  std::vector<double> poses;
  for (Row row : bodies) append(row.body.pose, poses);
  return {column("scene", "", bodies, [](Row row) { return row.scene.name; }),
          column("name", "", bodies, [](Row row) { return row.body.name; }),
          {"pose", "", std::move(poses), 7}};
}

std::vector<io::TableColumn> geom_columns(const std::vector<GeomOfScene>& geoms) {
  using Row = const GeomOfScene&;
  std::vector<double> sizes, poses;
  for (Row row : geoms) {
    sizes.insert(sizes.end(), row.geom.size.begin(), row.geom.size.end());
    append(row.geom.local, poses);
  }
  return {column("scene", "", geoms, [](Row row) { return row.scene.name; }),
          column("body", "", geoms, [](Row row) { return row.geom.body; }),
          column("kind", "", geoms, [](Row row) { return row.kind(); }),
          column("shape", "", geoms, [](Row row) { return std::string(name_of(row.geom.shape)); }),
          {"size", "m", std::move(sizes), 3},
          {"local", "", std::move(poses), 7}};
}

/// What a replay shows of scenes at rest: tables "bodies" and "geoms", scene by scene.
std::map<std::string, std::vector<io::TableColumn>> replay_tables(const std::vector<SceneModel>& scenes) {
  std::vector<BodyOfScene> bodies;
  std::vector<GeomOfScene> geoms;
  for (const SceneModel& scene : scenes) {
    for (const model::Body& body : scene.model->bodies) bodies.push_back({scene, body});
    for (const model::Geom& geom : scene.model->geoms) geoms.push_back({scene, geom});
  }
  return {{"bodies", body_columns(bodies)}, {"geoms", geom_columns(geoms)}};
}

/// "9 of 70 broken" for each setting, for the end of the run.
std::string stability_note(const StabilityRows& rows) {
  const std::vector<Judgement> judgements = judge_all(rows);
  std::string text =
      fmt::format("{:52} {:>5} {:>9} {:>7} {:>5}\n", "setting", "pass", "degraded", "broken", "n/a");
  for (std::size_t k = 0; k < rows.settings.size(); ++k) {
    std::array<int, 4> count{};
    for (std::size_t i = 0; i < rows.cases.size(); ++i) {
      if (rows.cases[i].setting == static_cast<int>(k))
        ++count[static_cast<std::size_t>(judgements[i].verdict)];
    }
    text += fmt::format("{:52} {:5} {:9} {:7} {:5}\n", setting_text(rows.settings[k]), count[0], count[1],
                        count[2], count[3]);
  }
  return text;
}

using Outcomes = CaseOutcomes<StabilityResult, CurvePoint, RecordedPose>;

Outcomes run_cases(const StabilityOptions& options, const std::vector<StabilityCase>& cases,
                   StudyRunner& runner) {
  return runner.run<StabilityResult, CurvePoint, RecordedPose>(cases, cost_of, [&](std::size_t i) {
    const StabilityCase& one = cases[i];
    const HardScene hard = build_hard_scene(runner.scene(one.scene), one.stepper.dt_s, options.seed);
    return run_stability_case(one, hard, options.most_poses);
  });
}

}  // namespace

core::ExitCode run_stability(const mpi::Communicator& comm, const std::vector<std::string>& args) {
  const StabilityOptions options = parse_stability_options(args);
  StudyRunner runner(comm, "stability", options);
  const std::vector<StabilityCase> cases = make_stability_cases(runner.scenes(), options);
  runner.open_output();
  const Outcomes measured = run_cases(options, cases, runner);
  runner.write([&] {
    const std::vector<RecordedPose>& poses = measured.rows_of<RecordedPose>();
    std::set<std::string> with_poses;
    for (const RecordedPose& pose : poses)
      with_poses.insert(runner.scene(cases[static_cast<std::size_t>(pose.case_index)].scene).source.name);
    std::vector<stability::HardCase> hard_cases;
    std::vector<SceneModel> models, replayed;
    for (const StudyScene& scene : runner.scenes()) {
      HardScene hard = build_hard_scene(scene, scene.dt_s, options.seed);
      hard_cases.push_back(std::move(hard.hard_case));
      models.push_back({scene.source.name, hard.model});
      if (with_poses.contains(scene.source.name)) replayed.push_back(models.back());
    }
    const StabilityRows rows{runner.scenes(), options.settings, hard_cases, cases, measured.results};
    StudyContent content;
    content.cases = stability_columns(rows);
    content.tables = stability_tables(measured.rows_of<CurvePoint>(), poses);
    content.tables.merge(replay_tables(replayed));
    content.tables["differences"] = engine_differences(models, steppers_of(cases));
    content.note = stability_note(rows);
    content.next = " --html stability.html";
    return content;
  });
  return core::ExitCode::done;
}

}  // namespace pbmpi::app
