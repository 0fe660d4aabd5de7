/// How far a setting is from the solution of its own equations, found by the same stepper from the same
/// states with so many iterations that more change little.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "app/pbstudy/accuracy/accuracy_cases.h"
#include "app/pbstudy/accuracy/case_runner.h"
#include "app/pbstudy/accuracy/nature.h"

namespace pbmpi::app {

/// Moves every coordinate of a position by up to `size` [m] and of a velocity by up to `size` [m/s], at
/// random by `key`. Orientations and angular velocities stay.
void disturb(double size, std::uint64_t key, model::State& state);

/// The own solutions of the cases of one scene, each made when first asked for. A world's result depends on
/// the world alone.
class OwnSolutions {
 public:
  /// All arguments are borrowed.
  OwnSolutions(const StudyScene& scene, const Nature& nature, const std::vector<AccuracyCase>& cases,
               const AccuracyOptions& options);

  /// Ends of the frames of case `index`, which has CaseKind::own; null for AccuracyCase::no_own.
  const FrameEnds* ends(int index);
  /// Judges a case of CaseKind::own against itself with a quarter of its iterations, or of
  /// CaseKind::own_floor against the undisturbed solution (`own_defect`), and both against nature
  /// (`defect`). `solve_iterations` are the iterations a step; all other observations are NaN.
  CaseResult judge(int index);

 private:
  struct Solution {
    Worlds worlds;
    FrameEnds ends;
    FrameEnds fewer;                           ///< with a quarter of the iterations
    std::vector<std::vector<int>> iterations;  ///< [frames][num_worlds] per step
    std::vector<double> times_s;               ///< [frames] of processor time, for everything that was tried
  };
  const Solution& solution(int index);
  Solution solve(const AccuracyCase& one) const;
  Solution solve_disturbed(const AccuracyCase& one, const Solution& own) const;
  const AccuracyCase& at(int index) const { return cases_[static_cast<std::size_t>(index)]; }

  const StudyScene& scene_;
  const Nature& nature_;
  const std::vector<AccuracyCase>& cases_;
  const AccuracyOptions& options_;
  std::map<int, Solution> solutions_;
};

}  // namespace pbmpi::app
