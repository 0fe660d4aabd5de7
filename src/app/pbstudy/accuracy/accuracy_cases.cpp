#include "app/pbstudy/accuracy/accuracy_cases.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <span>

#include "app/common/step_arguments.h"
#include "core/error.h"
#include "scenes/scene.h"

namespace pbmpi::app {
namespace {

using stepping::StepperSettings;

/// Steps that are studied by default: the scene's, half of it, and so on.
constexpr std::size_t default_dts = 4;

/// Steps of dt in a frame; they must fill it, except for rounding.
int steps_in_frame(const StudyScene& scene, double dt_s) {
  const double steps = scene.frame_s / dt_s;
  core::require_input(std::abs(steps - std::round(steps)) < 1e-6 && steps > 0.5,
                      "--dt " + std::to_string(dt_s) + " s: a frame of " + scene.source.name + " is " +
                          std::to_string(scene.frame_s) + " s, which is no whole number of such steps");
  return static_cast<int>(std::round(steps));
}

/// The frame of one precise setting, estimated by each number of iterations.
void add_estimates_of(AccuracyCase precise, const AccuracyOptions& options,
                      std::vector<AccuracyCase>& cases) {
  precise.kind = CaseKind::estimate;
  for (const int iterations : options.estimates) {
    if (iterations == 0) continue;
    precise.estimate = default_estimate(precise.stepper);
    precise.estimate->iterations = iterations;
    cases.push_back(precise);
  }
}

/// The lists of these options among those of the study.
std::vector<SettingList> lists_of(const AccuracyOptions& options,
                                  std::initializer_list<std::string_view> names) {
  std::vector<SettingList> lists;
  for (const SettingList& list : options.settings) {
    if (std::ranges::find(names, list.option->name) != names.end()) lists.push_back(list);
  }
  return lists;
}

/// Estimates of frames with the scene's own iterations, and with those of sor's soft law, in each law and
/// precision of the study.
void add_estimates(const AccuracyCase& base, const StudyScene& scene, const AccuracyOptions& options,
                   std::vector<AccuracyCase>& cases) {
  cross_settings(base.stepper, lists_of(options, {"law", "precision"}), [&](const StepperSettings& precise) {
    AccuracyCase one = base;
    one.stepper = precise;
    if (precise.law.name != stepping::Law::soft) one.stepper.iterations = scene.iterations;
    add_estimates_of(one, options, cases);
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

void add_matrix(int index, const StudyScene& scene, const AccuracyOptions& options,
                std::vector<AccuracyCase>& cases) {
  StepperSettings base;
  base.seed = options.seed;
  base.dt_s = scene.dt_s;
  SettingList dts = options.dts;
  if (dts.values.empty()) {
    for (StepperSettings one = base; dts.values.size() < default_dts; one.dt_s /= 2)
      dts.values.push_back(given_text(*dts.option, one));
  }
  cross_settings(base, {&dts, 1}, [&](const StepperSettings& with_dt) {
    const int steps = steps_in_frame(scene, with_dt.dt_s);
    cross_settings(with_dt, {&options.settings.front(), 1}, [&](const StepperSettings& with_kind) {
      const AccuracyCase first{index, CaseKind::setting, with_kind, steps};
      add_settings(first, options, cases);
      const bool is_first_step = given_text(*dts.option, with_kind) == dts.values.front();
      if (traits_of(with_kind.kind).iterates && is_first_step) add_estimates(first, scene, options, cases);
    });
  });
}

/// The case of nature: the way that gives its states, with the shortest steps. Throws core::InputError if
/// they cannot be halved.
AccuracyCase nature_case(int index, const StudyScene& scene, const AccuracyOptions& options) {
  const int steps = options.nature.most_steps, least = 2 * scene.steps_per_frame();
  core::require_input(steps >= least, "--nature-steps " + std::to_string(steps) + ": it must be at least " +
                                          std::to_string(least) + ", twice the steps of a frame of " +
                                          scene.name() + "; otherwise nothing says how far nature is known");
  return {index, CaseKind::nature, settings_of(Way::soft, scene.frame_s / steps, options.nature), steps};
}

bool solve_the_same(const StepperSettings& a, const StepperSettings& b) {
  return a.law == b.law &&
         std::ranges::all_of(stepping::step_options(), [&](const stepping::StepOption& option) {
           return value_of(option, a) == value_of(option, b);
         });
}

/// Adds the own solutions of the scene's settings (the cases from `first` on) at the first step of the study,
/// one for all settings that share it.
void add_own_solutions(std::size_t first, const AccuracyOptions& options, std::vector<AccuracyCase>& cases) {
  const std::size_t end = cases.size();
  for (std::size_t i = first; i < end; ++i) {
    if (cases[i].kind != CaseKind::setting || cases[i].stepper.dt_s != cases[first].stepper.dt_s) continue;
    const StepperSettings wanted = own_settings(cases[i].stepper, options.own_iterations);
    std::size_t own = end;
    while (own < cases.size() && !solve_the_same(cases[own].stepper, wanted)) ++own;
    if (own == cases.size()) {
      cases.push_back({cases[i].scene, CaseKind::own, wanted, cases[i].steps_per_frame});
      cases.back().own = static_cast<int>(own);
    }
    cases[i].own = static_cast<int>(own);
  }
}

/// Adds the noise of each kind of stepper, with its usual equations if they are studied.
void add_own_floors(std::size_t first, const AccuracyOptions& options, std::vector<AccuracyCase>& cases) {
  std::map<stepping::StepperKind, std::size_t> own_of;
  const std::size_t end = cases.size();
  for (std::size_t i = first; i < end; ++i) {
    if (cases[i].kind != CaseKind::own) continue;
    const StepperSettings& stepper = cases[i].stepper;
    own_of.try_emplace(stepper.kind, i);
    const StepperSettings usual =
        own_settings(usual_settings(stepper, stepping::Law::soft), options.own_iterations);
    if (solve_the_same(stepper, usual)) own_of[stepper.kind] = i;
  }
  for (const auto& [kind, own] : own_of) {
    for (int i = 1; i <= options.floor_seeds; ++i) {
      AccuracyCase floor = cases[own];
      floor.kind = CaseKind::own_floor;
      floor.stepper.seed += static_cast<std::uint64_t>(i);
      cases.push_back(floor);
    }
  }
}

}  // namespace

int AccuracyCase::sweeps_a_frame() const {
  return steps_per_frame * (estimate ? sweeps_of(*estimate) : sweeps());
}

StepperSettings own_settings(const StepperSettings& setting, int iterations) {
  const stepping::StepperTraits& traits = traits_of(setting.kind);
  StepperSettings own = setting;
  if (traits.iterates) own.iterations = std::max(1, iterations / setting.substeps);
  own.precision = StepperSettings{}.precision;
  own.tolerance_m = StepperSettings{}.tolerance_m;
  if (own.law.relax > 0) own.law.relax = own.iterations;
  return own;
}

std::vector<AccuracyCase> make_cases(const std::vector<StudyScene>& scenes, const AccuracyOptions& options) {
  std::vector<AccuracyCase> cases;
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const std::size_t first = cases.size();
    add_matrix(static_cast<int>(i), scenes[i], options, cases);
    cases.push_back(nature_case(static_cast<int>(i), scenes[i], options));
    if (options.own_iterations == 0) continue;
    add_own_solutions(first, options, cases);
    add_own_floors(first, options, cases);
  }
  return cases;
}

double cost_of(const AccuracyCase& one, const StudyScene& scene) {
  // A step costs its sweeps and a fixed part of about five more.
  return traits_of(one.stepper.kind).relative_cost * (one.sweeps() + 5) * one.steps_per_frame *
         scene.num_worlds;
}

}  // namespace pbmpi::app
