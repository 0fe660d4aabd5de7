#include "app/pbstudy/accuracy/accuracy_cases.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "core/error.h"
#include "mpi/balance/partition.h"

namespace pbmpi::app {
namespace {

using stepping::StepperSettings;

/// Steps of dt in a frame; they must fill it to within rounding.
int steps_in_frame(const StudyScene& scene, double dt_s) {
  const double steps = scene.frame_s / dt_s;
  core::require_input(std::abs(steps - std::round(steps)) < 1e-6 && steps > 0.5,
                      "--dt " + std::to_string(dt_s) + " s: a frame of " + scene.source.name + " is " +
                          std::to_string(scene.frame_s) + " s, which is no whole number of such steps");
  return static_cast<int>(std::round(steps));
}

/// Looks at the solve of the scene's own iterations, in each precision of the study.
void add_estimates(AccuracyCase base, const StudyScene& scene, const AccuracyOptions& options,
                   std::vector<AccuracyCase>& cases) {
  base.kind = CaseKind::estimate;
  base.stepper.iterations = scene.iterations;
  const auto precisions =
      std::ranges::find(options.settings, &stepping::step_option("precision"), &SettingList::option);
  cross_settings(base.stepper, {precisions, 1}, [&](const StepperSettings& stepper) {
    base.stepper = stepper;
    for (const int iterations : options.estimates) {
      base.estimate_iterations = iterations;
      if (iterations > 0 && iterations <= scene.iterations) cases.push_back(base);
    }
  });
}

/// All settings of one kind of stepper. `base` has the kind and dt.
void add_settings(const AccuracyCase& base, const AccuracyOptions& options,
                  std::vector<AccuracyCase>& cases) {
  const stepping::StepperTraits& traits = traits_of(base.stepper.kind);
  const std::span<const SettingList> lists = options.settings;
  AccuracyCase one = base;
  cross_settings(base.stepper, lists.subspan(1), [&](const StepperSettings& stepper) {
    one.stepper = stepper;
    if (!traits.has_substeps || one.sweeps() <= options.max_sweeps) cases.push_back(one);
  });
}

/// The settings with a memory from step to step: as the stepper is meant to be used, in the study's numbers
/// of substeps and precisions.
void add_remembering(const AccuracyCase& base, const AccuracyOptions& options,
                     std::vector<AccuracyCase>& cases) {
  AccuracyCase one = base;
  one.stepper = default_settings(base.stepper.kind);
  one.stepper.dt_s = base.stepper.dt_s;
  one.stepper.seed = base.stepper.seed;
  std::vector<SettingList> lists;
  for (const SettingList& list : options.settings) {
    if (list.option->name == "substeps" || list.option->name == "precision") lists.push_back(list);
  }
  cross_settings(one.stepper, lists, [&](const StepperSettings& stepper) {
    one.stepper = stepper;
    if (one.sweeps() <= options.max_sweeps) cases.push_back(one);
  });
}

void add_matrix(int index, const StudyScene& scene, const AccuracyOptions& options,
                std::vector<AccuracyCase>& cases) {
  StepperSettings base;
  base.seed = options.seed;
  base.dt_s = scene.dt_s;
  SettingList dts = options.dts;
  if (dts.values.empty()) {
    StepperSettings half = base;
    half.dt_s /= 2;
    dts.values = {text_of(*dts.option, base), text_of(*dts.option, half)};
  }
  cross_settings(base, {&dts, 1}, [&](const StepperSettings& with_dt) {
    const int steps = steps_in_frame(scene, with_dt.dt_s);
    cross_settings(with_dt, {&options.settings.front(), 1}, [&](const StepperSettings& with_kind) {
      const AccuracyCase first{index, CaseKind::setting, with_kind, steps};
      add_settings(first, options, cases);
      if (options.with_default && traits_of(with_kind.kind).tunes_sweeps)
        add_remembering(first, options, cases);
      const bool is_first_step = text_of(*dts.option, with_kind) == dts.values.front();
      if (traits_of(with_kind.kind).is_anytime && is_first_step) add_estimates(first, scene, options, cases);
    });
  });
}

void add_yardsticks(int index, const StudyScene& scene, const AccuracyOptions& options,
                    std::vector<AccuracyCase>& cases) {
  const AccuracyCase reference{index, CaseKind::floor, reference_settings(scene, options),
                               steps_in_frame(scene, scene.dt_s)};
  for (int i = 1; i <= options.floor_seeds; ++i) {
    cases.push_back(reference);
    cases.back().stepper.seed += static_cast<std::uint64_t>(i);
  }
  cases.push_back(reference);
  cases.back().kind = CaseKind::halved_iterations;
  cases.back().stepper.iterations /= 2;
  if (reference.stepper.substeps > 1) {
    cases.push_back(reference);
    cases.back().kind = CaseKind::halved_substeps;
    cases.back().stepper.substeps /= 2;
  }
  cases.push_back(reference);
  cases.back().kind = CaseKind::halved_dt;
  cases.back().stepper.dt_s /= 2;
  cases.back().steps_per_frame *= 2;
}

}  // namespace

StudyScene study_scene(const scenes::SceneSource& source, const AccuracyOptions& options) {
  return study_scene(source, options.overrides);
}

StepperSettings reference_settings(const StudyScene& scene, const AccuracyOptions& options) {
  StepperSettings reference;
  reference.kind = stepping::StepperKind::sor;
  reference.dt_s = scene.dt_s;
  reference.iterations = options.reference_iterations;
  reference.substeps = options.reference_substeps;
  reference.seed = options.seed;
  return reference;
}

std::vector<AccuracyCase> make_cases(const std::vector<StudyScene>& scenes, const AccuracyOptions& options) {
  std::vector<AccuracyCase> cases;
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    add_matrix(static_cast<int>(i), scenes[i], options, cases);
    add_yardsticks(static_cast<int>(i), scenes[i], options, cases);
  }
  return cases;
}

std::vector<int> deal_out(const std::vector<AccuracyCase>& cases, const std::vector<StudyScene>& scenes,
                          int num_ranks) {
  // A step costs its sweeps and a fixed part of about five more.
  std::vector<double> cost;
  for (const AccuracyCase& one : cases) {
    const double per_sweep = traits_of(one.stepper.kind).relative_cost;
    const StudyScene& scene = scenes[static_cast<std::size_t>(one.scene)];
    cost.push_back(per_sweep * (one.sweeps() + 5) * one.steps_per_frame * scene.num_worlds);
  }
  return mpi::lpt_placement(cost, num_ranks);
}

}  // namespace pbmpi::app
