/// The reference of "pbstudy accuracy": how far a step is solved, and the remaining error.
#pragma once

#include <map>
#include <memory>
#include <span>
#include <vector>

#include "app/pbstudy/study/case_stepper.h"
#include "model/state.h"
#include "stepping/stepper.h"

namespace pbmpi::app {

/// How far each step of each world is solved.
struct ReferenceSolve {
  stepping::StepperSettings
      stepper;  ///< sor with ODE's law; its iterations are those that each step is first tried with
  /// Required of each step: how far the natural map of its rows (stepping::Residuals) still moves within the
  /// step, as a length [m] and, for rows about axes, as an angle [rad]. 0: no requirement.
  double residual = 0;
  int most_iterations = 0;  ///< a step that has not got there by then stays as it is
};

/// The residual and iterations of a solve.
struct SolveAccount {
  double residual = 0;    ///< largest over all steps and worlds, as ReferenceSolve defines it
  double iterations = 0;  ///< mean over all steps and worlds
  int most_iterations = 0;
};

/// Steps worlds until each is solved as far as required. A world's result depends on the world alone.
class ConvergingStepper {
 public:
  ConvergingStepper(const Worlds& worlds, const ReferenceSolve& solve);
  ~ConvergingStepper();

  /// Puts all worlds into `states` [num_worlds] at the start of `step`.
  void start_from(const std::vector<model::State>& states, std::int64_t step);
  /// Takes a step of each world, repeated with four times as many iterations until it is solved far enough.
  void advance();
  /// Takes a step of each world with the given iterations, [num_worlds].
  void advance_with(std::span<const int> iterations);

  const std::vector<model::State>& states() const { return states_; }  ///< [num_worlds]
  const std::vector<int>& iterations() const { return iterations_; }   ///< of the last step, [num_worlds]
  const SolveAccount& account() const { return account_; }             ///< of all steps so far

 private:
  struct Level;
  Level& level(int iterations);
  /// Steps `worlds` from their states; sets their next_ and residual_.
  void try_step(std::span<const int> worlds, int iterations);
  void end_step();

  Worlds worlds_;
  ReferenceSolve solve_;
  std::map<int, std::unique_ptr<Level>> levels_;  ///< by iterations
  std::vector<model::State> states_, next_;       ///< [num_worlds]
  std::vector<double> residual_;                  ///< [num_worlds] of the step
  std::vector<int> iterations_;
  std::int64_t step_ = 0, steps_done_ = 0;
  SolveAccount account_;
};

/// The run that cases are compared with, and its iterations.
struct SolvedReference : Reference {
  std::vector<std::vector<int>> iterations;  ///< [steps][num_worlds]
  SolveAccount account;
};
SolvedReference solve_reference(const StudyScene& scene, const ReferenceSolve& solve);

}  // namespace pbmpi::app
