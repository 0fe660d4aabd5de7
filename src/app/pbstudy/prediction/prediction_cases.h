/// The cases of "pbstudy prediction": pure data, the same on every rank.
#pragma once

#include <string>
#include <vector>

#include "app/pbstudy/prediction/prediction_options.h"
#include "app/pbstudy/study/study_scene.h"

namespace pbmpi::app {

/// pbmpi on ODE in single precision, as in the paper; a build may lack it.
inline constexpr const char* ode_single_program = "pbmpi_ode_single";

/// A scene, the way to step it, and what is predicted.
struct PredictionCase {
  int scene = 0;                  ///< index into the study's scenes
  std::string name;               ///< "20Iter", "FVP6", "FEEC+FVP6", ...
  std::string program = "pbmpi";  ///< of this build
  std::string stepper = "quick", precision = "double";
  int iterations = 0;    ///< for quick
  bool feec = false;     ///< cycles are the estimate's
  double threshold = 0;  ///< 0: exact
  std::string scope = "all";
  bool has_cycles = true;
  bool has_variants = false;  ///< has rows in the sensitivity table
  double cost = 0;            ///< expected, in arbitrary units
};

/// All cases, scene by scene; each scene begins with "20Iter" (which also has the cycles of EVP).
std::vector<PredictionCase> make_prediction_cases(const std::vector<StudyScene>& scenes,
                                                  const PredictionOptions& options);

/// [num_cases] the rank that works on each case: dealt out by expected cost, the dearest first.
std::vector<int> deal_out(const std::vector<PredictionCase>& cases, int num_ranks);

/// "FVP6" for 1e-6.
std::string name_of_threshold(double threshold);

/// A processor of the sensitivity table: its changes to Table 3 (pbvalue's keys of --model).
struct ModelVariant {
  const char* name;
  const char* settings;
};
const std::vector<ModelVariant>& model_variants();

}  // namespace pbmpi::app
