/// The cases of "pbstudy prediction": pure data, the same on every rank.
#pragma once

#include <string>
#include <vector>

#include "app/pbstudy/prediction/prediction_options.h"
#include "app/pbstudy/study/study_scene.h"

namespace pbmpi::app {

/// pbmpi on ODE in single precision, which the paper ran; a build may lack it.
inline constexpr const char* ode_single_program = "pbmpi_ode_single";

/// A scene, a way to step it, and what is predicted.
struct PredictionCase {
  int scene = 0;                  ///< index into the study's scenes
  std::string name;               ///< "20Iter", "FVP6", "FEEC+FVP6", ...
  std::string program = "pbmpi";  ///< of this build
  std::string stepper = "quick", precision = "double";
  int iterations = 0;    ///< of quick
  bool feec = false;     ///< cycles are those of the estimate
  double threshold = 0;  ///< 0: exact
  std::string scope = "all";
  bool has_cycles = true;
  bool has_variants = false;  ///< rows of the sensitivity table
  double cost = 0;            ///< expected, in any unit
};

/// All cases, scene by scene; "20Iter" (with the cycles of EVP beside) is the first of each.
std::vector<PredictionCase> make_prediction_cases(const std::vector<StudyScene>& scenes,
                                                  const PredictionOptions& options);

/// Which rank works on which case [num_cases]: by expected cost, the dearest first.
std::vector<int> deal_out(const std::vector<PredictionCase>& cases, int num_ranks);

/// "FVP6" for 1e-6.
std::string name_of_threshold(double threshold);

/// A processor of the sensitivity table: what it changes of Table 3 (pbvalue's keys of --model).
struct ModelVariant {
  const char* name;
  const char* settings;
};
const std::vector<ModelVariant>& model_variants();

}  // namespace pbmpi::app
