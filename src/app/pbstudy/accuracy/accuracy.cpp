#include <iostream>
#include <optional>

#include "app/pbstudy/accuracy/accuracy_table.h"
#include "app/pbstudy/accuracy/own_solution.h"
#include "app/pbstudy/accuracy/yardsticks.h"
#include "app/pbstudy/study/engine_differences.h"
#include "app/pbstudy/study/studies.h"
#include "app/pbstudy/study/study_runner.h"

namespace pbmpi::app {
namespace {

using io::Parameter;

/// Each rank that has cases of a scene makes the scene's reference and own solutions itself.
std::vector<CaseResult> run_cases(const AccuracyOptions& options, const std::vector<AccuracyCase>& cases,
                                  StudyRunner& runner) {
  std::optional<SolvedReference> reference;
  std::optional<RestRunner> rest;
  std::optional<OwnSolutions> own;
  int reference_scene = -1;
  const auto cost = [&](const AccuracyCase& one) { return cost_of(one, runner.scene(one.scene)); };
  const auto run_one = [&](std::size_t i) {
    const StudyScene& scene = runner.scene(cases[i].scene);
    if (cases[i].scene != reference_scene) {
      reference = solve_reference(scene, reference_solve(scene, options));
      rest.emplace(scene, reference_settings(scene, options), options.rest_s);
      own.emplace(scene, *reference, cases, options);
      reference_scene = cases[i].scene;
    }
    if (is_own(cases[i].kind)) return own->judge(static_cast<int>(i));
    if (is_yardstick(cases[i].kind)) return run_yardstick(cases[i], scene, *reference, options);
    return run_case(cases[i], scene, *reference, *rest, options.repeats, own->ends(cases[i].own));
  };
  return runner.run<CaseResult>(cases, cost, run_one).results;
}

StudyContent content(const AccuracyOptions& options, const std::vector<StudyScene>& scenes,
                     const std::vector<AccuracyCase>& cases, const std::vector<CaseResult>& results) {
  StudyContent content;
  content.parameters = {
      Parameter::of("reference_stepper", "sor"),
      Parameter::of("reference_precision", "double"),
      Parameter::of("reference_iterations", std::int64_t{options.reference_iterations}),
      Parameter::of("reference_residual", options.reference_residual_m),
      Parameter::of("reference_most_iterations", std::int64_t{options.reference_most_iterations}),
      Parameter::of("reference_check", std::int64_t{options.reference_check}),
      Parameter::of("own_iterations", std::int64_t{options.own_iterations}),
      Parameter::of("own_most_iterations", std::int64_t{options.own_most_iterations}),
      Parameter::of("rest_seconds", options.rest_s)};
  content.cases = case_columns(scenes, cases, results);
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
  if (options.help) {
    if (comm.is_root()) std::cout << help_of(accuracy_manual(), args) << std::flush;
    return core::ExitCode::done;
  }
  StudyRunner runner(comm, "accuracy", options);
  const std::vector<AccuracyCase> cases = make_cases(runner.scenes(), options);
  runner.open_output();
  const std::vector<CaseResult> results = run_cases(options, cases, runner);
  runner.write([&] { return content(options, runner.scenes(), cases, results); });
  return core::ExitCode::done;
}

}  // namespace pbmpi::app
