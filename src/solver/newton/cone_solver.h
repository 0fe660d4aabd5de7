/// Solves a ConeProblem to residuals far below those that sweeps over its rows reach.
#pragma once

#include "solver/newton/cone_problem.h"

namespace pbmpi::solver {

/// Takes turns, until only rounding is left or the allowed work is done, between Newton's method on the
/// ConeMap with a line search; the same with a proximal term, shift (r - centre), whose centre moves and
/// whose shift fades (W is nearly singular, since only the CFM tells apart contacts that can share their load
/// in any proportion); and Gauss-Seidel sweeps. It returns the point of least residual that it met, the start
/// included.
class ConeSolver {
 public:
  explicit ConeSolver(const ConeProblem& problem);

  /// `impulses` [rows]: the start, replaced by the result.
  void solve(Numbers& impulses);
  /// abs(F) of impulses over the larger of abs(q) and abs(r), in units in which W_ii = 1 for each row with
  /// bounds, and for each contact's normal.
  double residual(const Numbers& impulses) const;

 private:
  /// Impulses, with their speeds and residual.
  struct Point {
    Numbers r, u, f;
    double residual = 0;
  };
  /// The proximal term: shift (r - centre) is added to the speeds.
  struct Proximal {
    double shift = 0;
    const Numbers* centre = nullptr;
  };

  static ConeProblem scaled(const ConeProblem& problem, const Numbers& scale);
  Numbers scaled(const Numbers& impulses) const;
  void look(const Proximal& proximal, Point& point) const;
  Point at(Numbers r) const;
  double tolerance(const Point& point) const;
  /// Goes from `point` to the least residual found; stops at `enough`.
  void step_by_newton(const Proximal& proximal, double enough, int most_steps, Point& point);
  Point search_line(const Proximal& proximal, const Point& from, const Numbers& direction) const;
  void move_centre(Point& best);
  void sweep(Numbers& r) const;
  void sweep_contact(int contact, Numbers& r) const;
  double speed(int row, const Numbers& r) const;
  bool is_done(const Point& best) const { return steps_left_ <= 0 || best.residual <= tolerance(best); }

  Numbers scale_;  ///< [rows] impulses are these factors times the scaled ones
  ConeProblem problem_;
  ConeMap map_;
  int steps_left_ = 0;
  DenseMatrix jacobian_;  ///< scratch
};

}  // namespace pbmpi::solver
