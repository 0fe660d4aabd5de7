#include "app/pbstudy/accuracy/accuracy_cases.h"

#include <cmath>

#include "core/error.h"
#include "mpi/balance/partition.h"

namespace pbmpi::app {
namespace {

using stepping::StepperKind;
using stepping::StepperSettings;

/// Steps of dt in a frame; they must fill it to within rounding.
int steps_in_frame(const StudyScene& scene, double dt_s) {
  const double steps = scene.frame_s / dt_s;
  core::require_input(std::abs(steps - std::round(steps)) < 1e-6 && steps > 0.5,
                      "--dt " + std::to_string(dt_s) + " s: a frame of " + scene.source.name + " is " +
                          std::to_string(scene.frame_s) + " s, which is no whole number of such steps");
  return static_cast<int>(std::round(steps));
}

/// One substep has nothing to take over from another.
void add_solver_settings(AccuracyCase base, const AccuracyOptions& options,
                         std::vector<AccuracyCase>& cases) {
  const bool several = base.stepper.substeps > 1;
  for (const double share : several ? options.warm_starts : std::vector<double>{0}) {
    base.stepper.warm_start = share;
    for (const stepping::RowOrder order : options.row_orders) {
      base.stepper.row_order = order;
      cases.push_back(base);
    }
  }
}

/// Looks at the solve of the scene's own iterations.
void add_estimates(AccuracyCase base, const StudyScene& scene, const AccuracyOptions& options,
                   std::vector<AccuracyCase>& cases) {
  base.kind = CaseKind::estimate;
  base.stepper.kind = StepperKind::sor;
  base.stepper.iterations = scene.iterations;
  for (const stepping::Precision precision : options.precisions) {
    base.stepper.precision = precision;
    for (const int iterations : options.estimates) {
      base.estimate_iterations = iterations;
      if (iterations > 0 && iterations <= scene.iterations) cases.push_back(base);
    }
  }
}

/// ODE's steppers have neither substeps nor a precision nor a factor to choose.
void add_settings(AccuracyCase base, const AccuracyOptions& options, std::vector<AccuracyCase>& cases) {
  if (base.stepper.kind != StepperKind::sor) {
    cases.push_back(base);
    return;
  }
  for (const int substeps : options.substeps) {
    base.stepper.substeps = substeps;
    if (base.sweeps() > options.max_sweeps) continue;
    for (const stepping::Precision precision : options.precisions) {
      base.stepper.precision = precision;
      for (const double factor : options.sor_factors) {
        base.stepper.sor_factor = factor;
        add_solver_settings(base, options, cases);
      }
    }
  }
}

void add_matrix(int index, const StudyScene& scene, const AccuracyOptions& options,
                std::vector<AccuracyCase>& cases) {
  const std::vector<double> dts_s = options.dts_s.empty() ? std::vector<double>{scene.dt_s} : options.dts_s;
  for (const double dt_s : dts_s) {
    AccuracyCase base{index, CaseKind::setting, {}, steps_in_frame(scene, dt_s)};
    base.stepper.seed = options.seed;
    base.stepper.dt_s = dt_s;
    for (const StepperKind kind : options.steppers) {
      base.stepper.kind = kind;
      for (const int iterations : options.iterations) {
        base.stepper.iterations = iterations;
        add_settings(base, options, cases);
        if (kind == StepperKind::direct) break;  // it has no iterations
      }
      if (kind == StepperKind::sor) add_estimates(base, scene, options, cases);
    }
  }
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
  reference.kind = StepperKind::sor;
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
  // Sweeps of a step, a fixed part of about five more, and quick at about five times the cost of sor.
  std::vector<double> cost;
  for (const AccuracyCase& one : cases) {
    const double per_sweep = one.stepper.kind == StepperKind::sor ? 1 : 5;
    const StudyScene& scene = scenes[static_cast<std::size_t>(one.scene)];
    cost.push_back(per_sweep * (one.sweeps() + 5) * one.steps_per_frame * scene.num_worlds);
  }
  return mpi::lpt_placement(cost, num_ranks);
}

}  // namespace pbmpi::app
