/// The reference of "pbstudy accuracy": how far a step is solved, and what that leaves open.
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
      stepper;  ///< a cold sor; its iterations are those that each step is tried with first
  /// Asked of each step: what the natural map of its rows (stepping::Residuals) still moves within the step,
  /// as a length [m] and, of rows about axes, as an angle [rad]. 0: nothing is asked.
  double residual = 0;
  int most_iterations = 0;  ///< a step that is not there by then is left at that
};

/// What it took.
struct SolveAccount {
  double residual = 0;    ///< largest of all steps and worlds, as ReferenceSolve has it
  double iterations = 0;  ///< mean of all steps and worlds
  int most_iterations = 0;
};

/// Steps worlds as far as they are asked to be solved. A world's result depends on nothing but the world.
class ConvergingStepper {
 public:
  ConvergingStepper(const Worlds& worlds, const ReferenceSolve& solve);
  ~ConvergingStepper();

  /// Puts all worlds into `states` [num_worlds], those at the start of `step`.
  void start_from(const std::vector<model::State>& states, std::int64_t step);
  /// A step of each world, with four times as many iterations again and again until it is solved so far.
  void advance();
  /// A step of each world with so many iterations, [num_worlds].
  void advance_with(std::span<const int> iterations);

  const std::vector<model::State>& states() const { return states_; }  ///< [num_worlds]
  const std::vector<int>& iterations() const { return iterations_; }   ///< of the last step, [num_worlds]
  const SolveAccount& account() const { return account_; }             ///< of all steps so far

 private:
  struct Level;
  Level& level(int iterations);
  /// Steps these worlds from their states; next_ and residual_ become theirs.
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

/// The run that cases are compared with, and what it took.
struct SolvedReference : Reference {
  std::vector<std::vector<int>> iterations;  ///< [steps][num_worlds]
  SolveAccount account;
};
SolvedReference solve_reference(const StudyScene& scene, const ReferenceSolve& solve);

}  // namespace pbmpi::app
