#include "app/pbstudy/prediction/prediction_cases.h"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

#include "core/error.h"
#include "mpi/balance/partition.h"

namespace pbmpi::app {
namespace {

int bodies_of(const StudyScene& scene) {
  return scenes::parse_scene(scene.source)->build(0, 1)->num_bodies() * scene.num_worlds;
}

class CaseList {
 public:
  CaseList(int scene, const StudyScene& study, std::vector<PredictionCase>& cases)
      : scene_(scene), iterations_(study.iterations), bodies_(bodies_of(study)), cases_(cases) {}

  PredictionCase& add(const std::string& name, double threshold) {
    PredictionCase one;
    one.scene = scene_;
    one.name = name;
    one.iterations = iterations_;
    one.threshold = threshold;
    cases_.push_back(one);
    return cases_.back();
  }
  /// Adds an exact case, and one with the threshold of Figure 8.
  void add_engine(const std::string& name, double threshold, bool has_cycles) {
    for (const double one_threshold : {0.0, threshold}) {
      PredictionCase& one =
          add(one_threshold > 0 ? name + " " + name_of_threshold(threshold) : name, one_threshold);
      one.has_cycles = has_cycles;
      if (name == "sor") one.stepper = "sor";
      if (name == "single") {
        one.program = ode_single_program;
        one.precision = "single";
      }
    }
  }
  /// Valgrind takes about as long to start as to step a hundred bodies; cycles take several times as long as
  /// hits, and a pair of variants the same again.
  void estimate_costs() {
    for (PredictionCase& one : cases_) {
      if (one.scene != scene_) continue;
      const double models = one.has_variants ? 1 + static_cast<double>(model_variants().size()) : 1;
      const double each = one.has_cycles && !one.feec ? 2 + 5 * models : 2;
      one.cost = 100 + bodies_ * each;
    }
  }

 private:
  int scene_, iterations_, bodies_;
  std::vector<PredictionCase>& cases_;
};

void add_scene(int index, const StudyScene& scene, const PredictionOptions& options,
               std::vector<PredictionCase>& cases) {
  CaseList list(index, scene, cases);
  const double first = options.thresholds.front();
  const std::string fvp = name_of_threshold(first);
  const bool in_detail = scene.source.name == options.detail_scene;
  list.add(fmt::format("{}Iter", scene.iterations), 0).has_variants = in_detail;
  list.add(fmt::format("{}Iter", scene.iterations - 1), 0).iterations = scene.iterations - 1;
  list.add("FEEC", 0).feec = true;
  list.add("FEEC+" + fvp, first).feec = true;
  for (const double threshold : options.thresholds) {
    PredictionCase& one = list.add(name_of_threshold(threshold), threshold);
    one.has_cycles = options.full || threshold == first;
    one.has_variants = in_detail && threshold == first;
  }
  if (in_detail) {
    for (const char* scope : {"collision", "step"}) list.add(fvp + " " + scope, first).scope = scope;
  }
  list.add_engine("sor", first, options.full);
  if (options.has_ode_single) list.add_engine("single", first, options.full);
  list.estimate_costs();
}

}  // namespace

std::vector<PredictionCase> make_prediction_cases(const std::vector<StudyScene>& scenes,
                                                  const PredictionOptions& options) {
  std::vector<PredictionCase> cases;
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    core::require_input(scenes[i].iterations > 1,
                        scenes[i].source.name + ": one iteration has none below it");
    add_scene(static_cast<int>(i), scenes[i], options, cases);
  }
  return cases;
}

std::vector<int> deal_out(const std::vector<PredictionCase>& cases, int num_ranks) {
  std::vector<double> cost;
  cost.reserve(cases.size());
  for (const PredictionCase& one : cases) cost.push_back(one.cost);
  return mpi::lpt_placement(cost, num_ranks);
}

std::string name_of_threshold(double threshold) {
  const double digits = -std::log10(threshold);
  const bool is_power = std::abs(digits - std::round(digits)) < 1e-9 && digits > 0.5;
  return is_power ? fmt::format("FVP{:.0f}", digits) : fmt::format("FVP({:g})", threshold);
}

const std::vector<ModelVariant>& model_variants() {
  static const std::vector<ModelVariant> variants = {
      {"Table 3", ""},
      {"width 4", "width=4"},
      {"width 16", "width=16"},
      {"window 64", "window=64"},
      {"window 512, no clusters", "window=512,clusters=0"},
      {"no clusters", "clusters=0"},
      {"branches guessed right", "perfect_branches=1"},
      {"all accesses hit", "perfect_caches=1"},
      {"floating point half as long", "fp_add=2,fp_mul=2,fp_div=10,fp_sqrt=14"},
      {"floating point twice as long", "fp_add=8,fp_mul=8,fp_div=40,fp_sqrt=54"},
      {"front end twice as long", "front_end=12"},
      {"ten cycles to execute again", "redo=10"},
  };
  return variants;
}

}  // namespace pbmpi::app
