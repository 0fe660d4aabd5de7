/// What a setting loses of its own equations: a stepper solved with so many iterations that more change
/// little, from the same states as its cases.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "app/pbstudy/accuracy/accuracy_cases.h"
#include "app/pbstudy/accuracy/case_runner.h"
#include "app/pbstudy/study/case_stepper.h"

namespace pbmpi::app {

/// Moves every coordinate of a position by up to `size` [m] and of a velocity by up to `size` [m/s], at
/// random by `key`. Orientations and turning stay.
void disturb(double size, std::uint64_t key, model::State& state);

/// The own solutions of the cases of one scene, each made when it is first asked for. A world's result
/// depends on nothing but the world.
class OwnSolutions {
 public:
  /// All are borrowed.
  OwnSolutions(const StudyScene& scene, const Reference& reference, const std::vector<AccuracyCase>& cases,
               const AccuracyOptions& options);

  /// Ends of the frames of case `index`, which is of CaseKind::own; null for AccuracyCase::no_own.
  const FrameEnds* ends(int index);
  /// Errors of a case of CaseKind::own, against itself with a quarter of its iterations, or of
  /// CaseKind::own_floor, against the undisturbed one (`own_defect`), and of both against the reference
  /// (`defect`). Iterations a step are `solve_iterations`; nothing else is observed: NaN.
  CaseResult judge(int index);

 private:
  struct Solution {
    Worlds worlds;
    FrameEnds ends;
    FrameEnds fewer;                           ///< with a quarter of the iterations
    std::vector<std::vector<int>> iterations;  ///< [frames][num_worlds] a step
    std::vector<double> times_s;               ///< [frames] of processor time, of all that was tried
  };
  const Solution& solution(int index);
  Solution solve(const AccuracyCase& one) const;
  Solution solve_disturbed(const AccuracyCase& one, const Solution& own) const;
  const AccuracyCase& at(int index) const { return cases_[static_cast<std::size_t>(index)]; }

  const StudyScene& scene_;
  const Reference& reference_;
  const std::vector<AccuracyCase>& cases_;
  const AccuracyOptions& options_;
  std::map<int, Solution> solutions_;
};

}  // namespace pbmpi::app
