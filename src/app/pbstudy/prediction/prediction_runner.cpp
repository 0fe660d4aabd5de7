#include "app/pbstudy/prediction/prediction_runner.h"

#include <filesystem>

#include <fmt/core.h>

#include "app/pbstudy/prediction/run_errors.h"
#include "app/pbstudy/prediction/tool_report.h"
#include "app/pbstudy/prediction/unpredicted_runs.h"
#include "core/error.h"

namespace pbmpi::app {
namespace {

/// The runs of one case under pbvalue.
class PredictedRuns {
 public:
  PredictedRuns(const PredictionCase& one, const StudyScene& scene, const PredictionOptions& options)
      : case_(one), scene_(scene), options_(options), runs_(options.time_limit_s) {}

  std::string file() const { return runs_.file("run.h5"); }
  std::string report() const { return runs_.file("tool.json"); }

  ChildRun run() {
    std::vector<std::string> command = tool();
    if (case_.has_cycles) add_models(command);
    return runs_.simulate("run", case_, scene_, std::move(command), step_options(case_.feec));
  }
  /// The step in which a number is no longer finite, found by a run with one step per frame. -1 if all
  /// numbers of that run stay finite.
  int find_step() {
    const ChildRun run = runs_.simulate("steps", case_, scene_, tool(), step_options(false), 1);
    return run.has_ended_well() ? run.nonfinite_frame() : -1;
  }
  nlohmann::json difference(const std::string& reference) {
    return runs_.difference(file(), reference).summary;
  }

 private:
  std::vector<std::string> tool() const {
    std::vector<std::string> command = {"valgrind", "--quiet", "--tool=pbvalue",
                                        "--pbvalue-out-file=" + report(), "--scope=" + case_.scope};
    if (case_.threshold > 0) command.push_back(fmt::format("--threshold={:.17g}", case_.threshold));
    command.insert(command.end(), options_.tool_options.begin(), options_.tool_options.end());
    return command;
  }
  void add_models(std::vector<std::string>& command) const {
    command.push_back(fmt::format("--first-modelled={}", scene_.warmup));
    command.emplace_back(case_.feec ? "--modelled=estimate" : "--modelled=precise");
    command.emplace_back("--model=none");
    command.emplace_back("--model=predicted:predict=1");
    if (!case_.has_variants) return;
    for (std::size_t i = 1; i < model_variants().size(); ++i) {
      const std::string settings = model_variants()[i].settings;
      command.push_back(fmt::format("--model=none{}:", i) + settings);
      command.push_back(fmt::format("--model=predicted{}:", i) + settings + ",predict=1");
    }
  }
  std::vector<std::string> step_options(bool feec) const {
    std::vector<std::string> words = seed_options(options_);
    for (std::string& word : iteration_options(case_, case_.iterations)) words.push_back(std::move(word));
    if (feec) words.emplace_back("--feec");
    return words;
  }

  const PredictionCase& case_;
  const StudyScene& scene_;
  const PredictionOptions& options_;
  ChildRuns runs_;
};

void compare(PredictedRuns& runs, const PredictionCase& one, const StudyScene& scene,
             const UnpredictedRun& base, PredictionResult& result) {
  constexpr auto all = static_cast<std::size_t>(-1);
  result.base_islands_mean = base.islands_mean;
  const nlohmann::json found = runs.difference(base.file);
  if (found.is_null()) return;
  result.errors_known = 1;
  result.same_hash = found.at("same_state_hash").get<bool>() ? 1 : 0;
  result.defect = joined_errors(found.at("drift_by_frame"), 0, 1);
  result.drift = joined_errors(found.at("drift_by_frame"), static_cast<std::size_t>(scene.warmup), all);
  if (one.feec && found.contains("estimate_drift"))
    result.drift = joined_errors(nlohmann::json::array({found.at("estimate_drift")}), 0, 1);
  result.floor = base.floor;
}

}  // namespace

void require_tool() {
  core::require_input(std::filesystem::exists(tool_folder() + "/pbvalue-amd64-linux"),
                      "this build has no Valgrind tool pbvalue (" + tool_folder() +
                          "); install Debian's valgrind, and configure and build again");
  // The files beside Valgrind's own tools are linked, not copied: an installed pbvalue may have lost them.
  core::require_input(std::filesystem::exists(tool_folder() + "/default.supp"),
                      "Valgrind is not installed, and pbvalue needs it (" + tool_folder() +
                          "/default.supp leads nowhere); install Debian's valgrind");
}

PredictionOutcome run_prediction_case(const PredictionCase& one, const StudyScene& scene,
                                      const PredictionOptions& options, int case_index,
                                      UnpredictedRuns& unpredicted) {
  const std::string what = scene.source.name + ", " + one.name;
  const UnpredictedRun& base = unpredicted.of(one, scene);
  PredictedRuns runs(one, scene, options);
  PredictionOutcome outcome;
  PredictionResult& result = outcome.result;
  const ChildRun run = runs.run();
  result.exit_code = run.end.timed_out ? -1 : run.end.exit_code;
  if (one.threshold == 0) require_end(run, what);  // fuzzy values may well crash the program
  result.ended = !run.end.timed_out && run.has_ended_well() ? 1 : 0;
  if (result.ended == 0) return outcome;
  if (!read_tool_report(runs.report(), one, case_index, outcome))
    throw core::RunError(what + ": pbvalue wrote no report\n" + run.errors);
  result.islands_mean = islands(run.summary, "mean");
  result.islands_max = islands(run.summary, "max");
  compare(runs, one, scene, base, result);
  result.nonfinite_frame = run.nonfinite_frame();
  if (result.nonfinite_frame >= 0) result.nonfinite_step = runs.find_step();
  return outcome;
}

}  // namespace pbmpi::app
