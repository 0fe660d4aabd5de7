#include "solver/newton/cone_solver.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace pbmpi::solver {
namespace {

constexpr int most_newton_steps = 600;  ///< in total, each an elimination
constexpr int first_sweeps = 10, most_sweeps = 320, most_rounds = 12;

Numbers scale_of(const ConeProblem& problem) {
  Numbers scale(problem.q.size());
  const int contact_rows = 3 * problem.num_contacts();
  for (int row = 0; row < problem.num_rows(); ++row) {
    const int of = row < contact_rows ? row - row % 3 : row;  // a contact's cone keeps its shape
    scale[static_cast<std::size_t>(row)] = 1 / std::sqrt(problem.w.row(of)[of]);
  }
  return scale;
}

}  // namespace

ConeSolver::ConeSolver(const ConeProblem& problem)
    : scale_(scale_of(problem)), problem_(scaled(problem, scale_)), map_(problem_) {}

ConeProblem ConeSolver::scaled(const ConeProblem& problem, const Numbers& scale) {
  ConeProblem result = problem;
  for (int i = 0; i < problem.num_rows(); ++i) {
    const double own = scale[static_cast<std::size_t>(i)];
    result.q[static_cast<std::size_t>(i)] *= own;
    for (int j = 0; j < problem.num_rows(); ++j)
      result.w.row(i)[j] *= own * scale[static_cast<std::size_t>(j)];
  }
  const std::size_t first = 3 * problem.mu.size();
  for (std::size_t k = 0; k < problem.low.size(); ++k) {
    result.low[k] /= scale[first + k];
    result.high[k] /= scale[first + k];
  }
  return result;
}

Numbers ConeSolver::scaled(const Numbers& impulses) const {
  Numbers r = impulses;
  for (std::size_t i = 0; i < r.size(); ++i) r[i] /= scale_[i];
  return r;
}

void ConeSolver::look(const Proximal& proximal, Point& point) const {
  find_speeds(problem_, point.r, point.u);
  if (proximal.centre != nullptr) {
    for (std::size_t i = 0; i < point.u.size(); ++i)
      point.u[i] += proximal.shift * (point.r[i] - (*proximal.centre)[i]);
  }
  map_.evaluate(point.r, point.u, point.f);
  point.residual = length_of(point.f);
}

ConeSolver::Point ConeSolver::at(Numbers r) const {
  Point point;
  point.r = std::move(r);
  look({}, point);
  return point;
}

/// Some hundred times the rounding error of u.
double ConeSolver::tolerance(const Point& point) const {
  return 1e-14 * std::max(length_of(problem_.q), length_of(point.r));
}

double ConeSolver::residual(const Numbers& impulses) const {
  const Point point = at(scaled(impulses));
  const double size = std::max(length_of(problem_.q), length_of(point.r));
  return size > 0 ? point.residual / size : 0;
}

/// Takes the first of 1, 1/2, ... 1/128 of the step that reduces the residual, else the least bad one: the
/// way out of a kink of F is through it.
ConeSolver::Point ConeSolver::search_line(const Proximal& proximal, const Point& from,
                                          const Numbers& direction) const {
  Point best, trial;
  double share = 1;
  for (int halved = 0; halved < 8; ++halved, share /= 2) {
    trial.r = from.r;
    for (std::size_t i = 0; i < trial.r.size(); ++i) trial.r[i] += share * direction[i];
    look(proximal, trial);
    if (best.r.empty() || trial.residual < best.residual) best = trial;
    if (trial.residual < (1 - 0.1 * share) * from.residual) break;
  }
  return best;
}

void ConeSolver::step_by_newton(const Proximal& proximal, double enough, int most_steps, Point& point) {
  constexpr int most_stalls = 5;
  look(proximal, point);
  Point here = point;
  for (int step = 0, stalls = 0; step < most_steps && stalls <= most_stalls; ++step) {
    if (!(here.residual > enough) || steps_left_ <= 0) break;
    --steps_left_;
    map_.differentiate(here.r, here.u, proximal.shift, jacobian_);
    Numbers direction = here.f;
    for (double& number : direction) number = -number;
    if (!solve_by_elimination(jacobian_, direction)) break;
    here = search_line(proximal, here, direction);
    if (!std::isfinite(here.residual)) break;
    stalls = here.residual < 0.9 * point.residual ? 0 : stalls + 1;
    if (here.residual < point.residual) point = here;
  }
}

/// Takes proximal points from the best on: a subproblem that is solved lets the term fade, one that is not
/// lets it grow.
void ConeSolver::move_centre(Point& best) {
  constexpr int most_failures = 4, most_moves = 40, most_steps = 30;
  constexpr double first_shift = 1e-2, least_shift = 1e-14;
  Point point = best;
  double shift = first_shift;
  for (int move = 0, failures = 0; move < most_moves && failures < most_failures; ++move) {
    if (shift < least_shift || is_done(best)) return;
    const Numbers centre = point.r;
    const double enough = std::min(10 * tolerance(best), 1e-3 * best.residual);
    step_by_newton({shift, &centre}, enough, most_steps, point);
    const double left = point.residual;
    look({}, point);
    if (point.residual < best.residual) best = point;
    if (left <= std::max(1e-2 * point.residual, 100 * tolerance(best))) {
      shift *= 0.1;
    } else {
      shift *= 3;
      ++failures;
      if (!(point.residual < 1.5 * best.residual)) point = best;
    }
  }
}

double ConeSolver::speed(int row, const Numbers& r) const {
  double sum = problem_.q[static_cast<std::size_t>(row)];
  const double* w = problem_.w.row(row);
  for (std::size_t j = 0; j < r.size(); ++j) sum += w[j] * r[j];
  return sum;
}

/// Solves the normal, then friction as in ContactSolver, three times over.
void ConeSolver::sweep_contact(int contact, Numbers& r) const {
  constexpr int repeats = 3;
  const int row = 3 * contact;
  const auto i = static_cast<std::size_t>(row);
  const double* w[3] = {problem_.w.row(row), problem_.w.row(row + 1), problem_.w.row(row + 2)};
  double u[3] = {speed(row, r), speed(row + 1, r), speed(row + 2, r)};
  const auto change = [&](int k, double by) {
    r[i + static_cast<std::size_t>(k)] += by;
    for (int other = 0; other < 3; ++other) u[other] += w[other][row + k] * by;
  };
  const double first = w[1][row + 1], second = w[2][row + 2], across = w[1][row + 2];
  const double determinant = first * second - across * across;
  for (int repeat = 0; repeat < repeats; ++repeat) {
    change(0, std::max(r[i] - map_.rho(row) * u[0], 0.0) - r[i]);
    const double bound = problem_.mu[static_cast<std::size_t>(contact)] * r[i];
    double to[2] = {r[i + 1] - (second * u[1] - across * u[2]) / determinant,
                    r[i + 2] - (first * u[2] - across * u[1]) / determinant};
    if (!(to[0] * to[0] + to[1] * to[1] <= bound * bound)) {
      for (int k = 0; k < 2; ++k)
        to[k] = r[i + 1 + static_cast<std::size_t>(k)] - map_.rho(row + 1) * u[1 + k];
      const double length = std::sqrt(to[0] * to[0] + to[1] * to[1]);
      const double share = length > bound ? bound / length : 1;
      for (double& number : to) number *= share;
    }
    const double by[2] = {to[0] - r[i + 1], to[1] - r[i + 2]};
    change(1, by[0]);
    change(2, by[1]);
  }
}

void ConeSolver::sweep(Numbers& r) const {
  for (int contact = 0; contact < problem_.num_contacts(); ++contact) sweep_contact(contact, r);
  for (int row = 3 * problem_.num_contacts(), k = 0; row < problem_.num_rows(); ++row, ++k) {
    double& impulse = r[static_cast<std::size_t>(row)];
    const auto bound = static_cast<std::size_t>(k);
    impulse = std::clamp(impulse - map_.rho(row) * speed(row, r), problem_.low[bound], problem_.high[bound]);
  }
}

void ConeSolver::solve(Numbers& impulses) {
  steps_left_ = most_newton_steps;
  Point best = at(scaled(impulses));
  if (!std::isfinite(best.residual)) return;
  int sweeps = first_sweeps;
  for (int round = 0; round < most_rounds && !is_done(best); ++round) {
    step_by_newton({}, tolerance(best), 20, best);
    if (is_done(best)) break;
    move_centre(best);
    if (is_done(best)) break;
    Numbers swept = best.r;
    for (int i = 0; i < sweeps; ++i) sweep(swept);
    Point point = at(std::move(swept));
    if (point.residual < best.residual) best = std::move(point);
    sweeps = std::min(2 * sweeps, most_sweeps);
  }
  for (std::size_t i = 0; i < impulses.size(); ++i) impulses[i] = best.r[i] * scale_[i];
}

}  // namespace pbmpi::solver
