#include "app/pbstudy/prediction/unpredicted_runs.h"

#include <cmath>

#include "app/pbstudy/prediction/run_errors.h"

namespace pbmpi::app {

std::vector<std::string> seed_options(const PredictionOptions& options, int solver_seed_offset) {
  std::vector<std::string> words = {"--seed", std::to_string(options.seed)};
  if (solver_seed_offset != 0) {
    words.emplace_back("--solver-seed");
    words.push_back(std::to_string(options.seed + static_cast<unsigned>(solver_seed_offset)));
  }
  return words;
}

std::vector<std::string> iteration_options(const PredictionCase& one, int iterations) {
  if (one.stepper != "quick") return {};
  return {"--iterations", std::to_string(iterations)};
}

double islands(const nlohmann::json& summary, const char* which) {
  return summary.is_null() || !summary.contains("islands") ? NAN
                                                           : summary.at("islands").at(which).get<double>();
}

const UnpredictedRun& UnpredictedRuns::of(const PredictionCase& one, const StudyScene& scene) {
  const std::pair<int, std::string> key{one.scene, one.program + " " + one.stepper};
  const auto found = done_.find(key);
  return found != done_.end() ? found->second : done_.emplace(key, run(one, scene)).first->second;
}

UnpredictedRun UnpredictedRuns::run(const PredictionCase& one, const StudyScene& scene) {
  const std::string what = scene.source.name + ", " + one.name;
  const std::string name = std::to_string(done_.size());
  std::vector<std::string> iterations = iteration_options(one, scene.iterations);
  const auto with = [&](std::vector<std::string> words) {
    words.insert(words.end(), iterations.begin(), iterations.end());
    return words;
  };
  const ChildRun base = runs_.simulate(name, one, scene, {}, with(seed_options(options_)));
  require_end(base, what + ": the unpredicted run");
  const ChildRun other = runs_.simulate("floor", one, scene, {}, with(seed_options(options_, 1)));
  require_end(other, what + ": the run of another seed");
  UnpredictedRun result;
  result.file = runs_.file(name + ".h5");
  result.islands_mean = islands(base.summary, "mean");
  const nlohmann::json floor = runs_.difference(runs_.file("floor.h5"), result.file).summary;
  if (!floor.is_null())
    result.floor = joined_errors(floor.at("drift_by_frame"), static_cast<std::size_t>(scene.warmup),
                                 static_cast<std::size_t>(-1));
  return result;
}

}  // namespace pbmpi::app
