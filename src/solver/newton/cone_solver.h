/// Solves a ConeProblem far below what sweeps over its rows reach.
#pragma once

#include "solver/newton/cone_problem.h"

namespace pbmpi::solver {

/// In turn, until rounding is all that is left or the work allowed is done: Newton's method on the ConeMap
/// with a line search; the same with a proximal term, shift (r - centre), that moves its centre and fades (as
/// of contacts that share their load in any proportion only the CFM tells them apart, W is next to singular);
/// Gauss-Seidel sweeps. What it returns has the least residual of all that it came by, the start included.
class ConeSolver {
 public:
  explicit ConeSolver(const ConeProblem& problem);

  /// `impulses` [rows]: from where it starts, and where it ends.
  void solve(Numbers& impulses);
  /// abs(F) of impulses over the largest of abs(q), abs(r), in units in which each row has W_ii = 1, and a
  /// contact its normal.
  double residual(const Numbers& impulses) const;

 private:
  /// A place, with its speeds and the residual there.
  struct Point {
    Numbers r, u, f;
    double residual = 0;
  };
  /// shift (r - centre) is added to the speeds.
  struct Proximal {
    double shift = 0;
    const Numbers* centre = nullptr;
  };

  static ConeProblem scaled(const ConeProblem& problem, const Numbers& scale);
  Numbers scaled(const Numbers& impulses) const;
  void look(const Proximal& proximal, Point& point) const;
  Point at(Numbers r) const;
  double tolerance(const Point& point) const;
  /// From `point` to the least residual found; ends at `enough`.
  void step_by_newton(const Proximal& proximal, double enough, int most_steps, Point& point);
  Point search_line(const Proximal& proximal, const Point& from, const Numbers& direction) const;
  void move_centre(Point& best);
  void sweep(Numbers& r) const;
  void sweep_contact(int contact, Numbers& r) const;
  double speed(int row, const Numbers& r) const;
  bool is_done(const Point& best) const { return steps_left_ <= 0 || best.residual <= tolerance(best); }

  Numbers scale_;  ///< [rows] impulses are these times scaled ones
  ConeProblem problem_;
  ConeMap map_;
  int steps_left_ = 0;
  DenseMatrix jacobian_;  ///< scratch
};

}  // namespace pbmpi::solver
