#include "app/pbstudy/prediction/prediction.h"

#include <algorithm>
#include <iostream>

#include <fmt/core.h>

#include "app/pbstudy/prediction/child_runs.h"
#include "app/pbstudy/prediction/prediction_table.h"
#include "app/pbstudy/prediction/unpredicted_runs.h"
#include "app/pbstudy/study/study_runner.h"

namespace pbmpi::app {
namespace {

/// 100CrSk has a hundred worlds that differ little; the default form takes ten of them.
constexpr int most_worlds = 10;

using Outcomes = CaseOutcomes<PredictionResult, PredictedFrame, VariantCycles>;

Outcomes run_cases(const mpi::Communicator& comm, const PredictionOptions& options,
                   const std::vector<PredictionCase>& cases, const std::vector<StudyScene>& scenes,
                   StudyRunner& runner) {
  UnpredictedRuns unpredicted(options);
  return runner.run<PredictionResult, PredictedFrame, VariantCycles>(
      cases, deal_out(cases, comm.size()), [&](std::size_t i) {
        return run_prediction_case(cases[i], scenes[static_cast<std::size_t>(cases[i].scene)], options,
                                   static_cast<int>(i), unpredicted);
      });
}

/// Is `program` there for root? Every rank gets the same answer.
bool has_on_root(const mpi::Communicator& comm, const char* program) {
  std::int32_t has = has_program(program) ? 1 : 0;
  comm.bcast_value(has);
  return has != 0;
}

std::vector<StudyScene> in_their_form(std::vector<StudyScene> scenes, const PredictionOptions& options) {
  for (StudyScene& scene : scenes) {
    if (!options.full && !options.overrides.replicas)
      scene.num_worlds = std::min(scene.num_worlds, most_worlds);
  }
  return scenes;
}

}  // namespace

core::ExitCode run_prediction(const mpi::Communicator& comm, const std::vector<std::string>& args) {
  PredictionOptions options = parse_prediction_options(args);
  if (options.help) {
    if (comm.is_root()) std::cout << help_of(prediction_manual(), args) << std::flush;
    return core::ExitCode::done;
  }
  require_tool();
  options.has_ode_single = has_on_root(comm, ode_single_program);
  StudyRunner runner(comm, "prediction", options);
  const std::vector<StudyScene> scenes = in_their_form(runner.scenes(), options);
  const std::vector<PredictionCase> cases = make_prediction_cases(scenes, options);
  runner.open_output();
  const Outcomes measured = run_cases(comm, options, cases, scenes, runner);
  runner.write([&] {
    const PredictionRows rows{scenes, cases, measured.results, measured.rows_of<PredictedFrame>(),
                              measured.rows_of<VariantCycles>()};
    StudyContent content;
    content.cases = prediction_columns(rows);
    content.tables = prediction_tables(rows);
    content.parameters = {io::Parameter::of("budget_s", options.budget_s),
                          io::Parameter::of("figure_threshold", options.thresholds.front())};
    if (!options.has_ode_single)
      content.note =
          fmt::format("no runs of quick in single precision: this build has no {} (jobs/ode_single.sh)\n",
                      ode_single_program);
    content.report = "jobs/paper/paper.py prediction";
    content.next = " --html prediction.html";
    return content;
  });
  return core::ExitCode::done;
}

}  // namespace pbmpi::app
