#include <string>
#include <vector>

#include "analysis/error_bands.h"
#include "app/pbstudy/stability/stability_runner.h"
#include "app/pbstudy/study/engine_differences.h"
#include "app/pbstudy/study/study_runner.h"
#include "app/pbstudy/study/table_columns.h"
#include "io/table/table_file.h"
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

std::vector<StabilityResult> run_cases(const StabilityOptions& options,
                                       const std::vector<StabilityCase>& cases, StudyRunner& runner) {
  const auto run_one = [&](std::size_t i) {
    const StabilityCase& one = cases[i];
    return run_stability_case(one, build_hard_scene(runner.scene(one.scene), one.stepper.dt_s, options.seed));
  };
  return runner.run<StabilityResult>(cases, cost_of, run_one).results;
}

}  // namespace

core::ExitCode run_stability(const mpi::Communicator& comm, const std::vector<std::string>& args) {
  const StabilityOptions options = parse_stability_options(args);
  StudyRunner runner(comm, "stability", options);
  const std::vector<StabilityCase> cases = make_stability_cases(runner.scenes(), options);
  runner.open_output();
  const std::vector<StabilityResult> results = run_cases(options, cases, runner);
  runner.write([&] {
    std::vector<stability::HardCase> hard_cases;
    std::vector<SceneModel> models;
    for (const StudyScene& scene : runner.scenes()) {
      HardScene hard = build_hard_scene(scene, scene.dt_s, options.seed);
      hard_cases.push_back(std::move(hard.hard_case));
      models.push_back({scene.source.name, hard.model});
    }
    const StabilityRows rows{runner.scenes(), options.settings, hard_cases, cases, results};
    StudyContent content;
    content.cases = stability_columns(rows);
    content.tables["differences"] = engine_differences(models, steppers_of(cases));
    content.next = " --html stability.html";
    return content;
  });
  return core::ExitCode::done;
}

}  // namespace pbmpi::app
