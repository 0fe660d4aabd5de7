/// The runs without prediction that all cases of a scene and a stepper are compared with.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <utility>

#include "analysis/error_table.h"
#include "app/pbstudy/prediction/child_runs.h"

namespace pbmpi::app {

struct UnpredictedRun {
  std::string file;
  double islands_mean = 0;
  analysis::ErrorTable floor;  ///< drift over the measured frames, caused by another solver seed
};

/// Each is run when first asked for, and its file stays as long as this object.
class UnpredictedRuns {
 public:
  explicit UnpredictedRuns(const PredictionOptions& options)
      : options_(options), runs_(options.time_limit_s) {}

  /// The run with the scene's iterations and without FEEC, whatever the case's. Throws core::RunError if a
  /// run ends abnormally.
  const UnpredictedRun& of(const PredictionCase& one, const StudyScene& scene);

 private:
  UnpredictedRun run(const PredictionCase& one, const StudyScene& scene);

  const PredictionOptions& options_;
  ChildRuns runs_;
  std::map<std::pair<int, std::string>, UnpredictedRun> done_;  ///< by scene, and by program with stepper
};

/// Options of pbmpi that set iterations (quick) and seeds.
std::vector<std::string> seed_options(const PredictionOptions& options, int solver_seed_offset = 0);
std::vector<std::string> iteration_options(const PredictionCase& one, int iterations);

/// Mean or largest number of islands of a run; NaN if unknown. `which`: "mean" or "max".
double islands(const nlohmann::json& summary, const char* which);

}  // namespace pbmpi::app
