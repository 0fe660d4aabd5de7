#include "app/pbstudy/accuracy/yardsticks.h"

#include <cmath>

#include "core/clock.h"

namespace pbmpi::app {
namespace {

/// The defect of the measured frames.
void measure_defect(const StudyScene& scene, const SolvedReference& reference, const Worlds& worlds,
                    const SolveFrame& solve, CaseResult& result) {
  analysis::PoseErrors errors;
  std::vector<std::vector<double>> times_s;
  for (int frame = scene.warmup; frame < scene.total_frames(); ++frame) {
    const auto at = static_cast<std::size_t>(frame);
    const double start_s = core::thread_cpu_s();
    const States end = solve(reference.states[at], frame);
    times_s.push_back({core::thread_cpu_s() - start_s});
    errors.append(errors_between(worlds, end, reference.states[at + 1]));
  }
  result.defect = analysis::summarize(errors);
  summarize_times(times_s, result);
}

/// Solves the reference anew, with the case's seed and step.
CaseResult solve_anew(const AccuracyCase& one, const StudyScene& scene, const SolvedReference& reference,
                      const AccuracyOptions& options) {
  const Worlds worlds = worlds_at_step(reference, scene, one.stepper.dt_s, options.seed);
  ReferenceSolve asked = reference_solve(scene, options);
  asked.stepper = one.stepper;
  ConvergingStepper stepper(worlds, asked);
  const SolveFrame solve = [&](const States& start, int frame) {
    stepper.start_from(start, static_cast<std::int64_t>(frame) * one.steps_per_frame);
    for (int step = 0; step < one.steps_per_frame; ++step) stepper.advance();
    return stepper.states();
  };
  CaseResult result = unobserved();
  measure_defect(scene, reference, worlds, solve, result);
  result.drift = drift_of(scene, reference, worlds, solve);
  result.solve_residual = stepper.account().residual;
  result.solve_iterations = stepper.account().iterations;
  return result;
}

CaseResult solve_further(const AccuracyCase& one, const StudyScene& scene, const SolvedReference& reference,
                         const AccuracyOptions& options) {
  ConvergingStepper stepper(reference.worlds, reference_solve(scene, options));
  const SolveFrame solve = [&](const States& start, int frame) {
    const std::int64_t first = static_cast<std::int64_t>(frame) * one.steps_per_frame;
    stepper.start_from(start, first);
    for (std::int64_t step = first; step < first + one.steps_per_frame; ++step) {
      std::vector<int> iterations = reference.iterations[static_cast<std::size_t>(step)];
      for (int& count : iterations) count *= options.reference_check;
      stepper.advance_with(iterations);
    }
    return stepper.states();
  };
  CaseResult result = unobserved();
  measure_defect(scene, reference, reference.worlds, solve, result);
  result.solve_residual = stepper.account().residual;
  result.solve_iterations = stepper.account().iterations;
  return result;
}

CaseResult solve_otherwise(const AccuracyCase& one, const StudyScene& scene,
                           const SolvedReference& reference) {
  CaseStepper stepper(reference.worlds, one.stepper, one.steps_per_frame);
  CaseResult result = unobserved();
  const SolveFrame solve = [&](const States& start, int frame) {
    stepper.start_from(start, frame);
    stepper.advance_frame();
    return stepper.states();
  };
  measure_defect(scene, reference, reference.worlds, solve, result);
  return result;
}

/// Result of the reference itself: no error, and the cost of its solve.
CaseResult account_for(const StudyScene& scene, const SolvedReference& reference) {
  const SolveFrame look_up = [&](const States&, int frame) {
    return reference.states[static_cast<std::size_t>(frame) + 1];
  };
  CaseResult result = unobserved();
  measure_defect(scene, reference, reference.worlds, look_up, result);
  result.drift = drift_of(scene, reference, reference.worlds, look_up);
  result.solve_residual = reference.account.residual;
  result.solve_iterations = reference.account.iterations;
  return result;
}

}  // namespace

CaseResult run_yardstick(const AccuracyCase& one, const StudyScene& scene, const SolvedReference& reference,
                         const AccuracyOptions& options) {
  if (one.kind == CaseKind::reference) return account_for(scene, reference);
  if (one.kind == CaseKind::more_iterations) return solve_further(one, scene, reference, options);
  if (one.kind == CaseKind::second_method) return solve_otherwise(one, scene, reference);
  return solve_anew(one, scene, reference, options);
}

}  // namespace pbmpi::app
