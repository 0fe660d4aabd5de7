#include "app/pbstudy/prediction/prediction.h"

#include <algorithm>
#include <iostream>

#include "app/common/format.h"
#include "app/pbstudy/prediction/child_runs.h"
#include "app/pbstudy/prediction/prediction_table.h"
#include "app/pbstudy/prediction/unpredicted_runs.h"
#include "app/pbstudy/study/study_runner.h"

namespace pbmpi::app {
namespace {

/// 100CrSk has a hundred worlds that differ little: ten of them in the default form.
constexpr int most_worlds = 10;

struct Measured {
  std::vector<PredictionResult> results;
  std::vector<PredictedFrame> frames;
  std::vector<VariantCycles> variants;
};

template <class Row>
std::vector<Row> gathered(const mpi::Communicator& comm, const std::vector<Row>& own) {
  std::vector<Row> all = comm.allgatherv(std::span<const Row>(own));
  std::ranges::stable_sort(all, {}, &Row::case_index);
  return all;
}

Measured run_cases(const mpi::Communicator& comm, const PredictionOptions& options,
                   const std::vector<PredictionCase>& cases, const std::vector<StudyScene>& scenes,
                   StudyRunner& runner) {
  Measured own, all;
  UnpredictedRuns unpredicted(options);
  all.results = runner.run<PredictionResult>(cases, deal_out(cases, comm.size()), [&](std::size_t i) {
    const PredictionOutcome outcome =
        run_prediction_case(cases[i], scenes[static_cast<std::size_t>(cases[i].scene)], options,
                            static_cast<int>(i), unpredicted);
    own.frames.insert(own.frames.end(), outcome.frames.begin(), outcome.frames.end());
    own.variants.insert(own.variants.end(), outcome.variants.begin(), outcome.variants.end());
    return outcome.result;
  });
  all.frames = gathered(comm, own.frames);
  all.variants = gathered(comm, own.variants);
  return all;
}

/// The same answer on every rank.
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
    if (comm.is_root()) std::cout << prediction_help_text() << std::flush;
    return core::ExitCode::done;
  }
  require_tool();
  options.has_ode_single = has_on_root(comm, ode_single_program);
  StudyRunner runner(comm, "prediction", options);
  const std::vector<StudyScene> scenes = in_their_form(runner.scenes(), options);
  const std::vector<PredictionCase> cases = make_prediction_cases(scenes, options);
  runner.open_output();
  const Measured measured = run_cases(comm, options, cases, scenes, runner);
  runner.write([&] {
    const PredictionRows rows{scenes, cases, measured.results, measured.frames, measured.variants};
    StudyContent content;
    content.cases = prediction_columns(rows);
    content.tables = prediction_tables(rows);
    content.parameters = {io::Parameter::of("budget_s", options.budget_s),
                          io::Parameter::of("figure_threshold", options.thresholds.front())};
    if (!options.has_ode_single)
      content.note =
          format("no runs of quick in single precision: this build has no %s (jobs/ode_single.sh)\n",
                 ode_single_program);
    content.next = " --html prediction.html";
    return content;
  });
  return core::ExitCode::done;
}

}  // namespace pbmpi::app
