#include <optional>

#include <fmt/core.h>

#include "app/pbstudy/accuracy/case_runner.h"
#include "app/pbstudy/accuracy/nature_rows.h"
#include "app/pbstudy/accuracy/own_solution.h"
#include "app/pbstudy/study/engine_differences.h"
#include "app/pbstudy/study/studies.h"
#include "app/pbstudy/study/study_runner.h"

namespace pbmpi::app {
namespace {

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
