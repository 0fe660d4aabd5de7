#include <set>

#include "app/pbstudy/stability/stability_table.h"
#include "app/pbstudy/study/engine_differences.h"
#include "app/pbstudy/study/studies.h"
#include "app/pbstudy/study/study_runner.h"

namespace pbmpi::app {
namespace {

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
