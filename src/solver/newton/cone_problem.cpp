#include "solver/newton/cone_problem.h"

#include <algorithm>
#include <cmath>

namespace pbmpi::solver {

ConeMap::ConeMap(const ConeProblem& problem)
    : problem_(problem), rho_(static_cast<std::size_t>(problem.num_rows())) {
  for (int i = 0; i < problem.num_rows(); ++i) rho_[static_cast<std::size_t>(i)] = 1 / problem.w.row(i)[i];
  for (int c = 0; c < problem.num_contacts(); ++c) {
    const int row = 3 * c + 1;
    const double first = problem.w.row(row)[row], second = problem.w.row(row + 1)[row + 1];
    const double half = (first - second) / 2, across = problem.w.row(row)[row + 1];
    const auto i = static_cast<std::size_t>(row);
    rho_[i] = rho_[i + 1] = 1 / ((first + second) / 2 + std::sqrt(half * half + across * across));
  }
}

ConeMap::Trial ConeMap::try_contact(int contact, const Numbers& r, const Numbers& u) const {
  const auto i = static_cast<std::size_t>(3 * contact);
  Trial trial{
      r[i] - rho_[i] * u[i], {r[i + 1] - rho_[i + 1] * u[i + 1], r[i + 2] - rho_[i + 2] * u[i + 2]}, 0, 0};
  trial.length = std::sqrt(trial.across[0] * trial.across[0] + trial.across[1] * trial.across[1]);
  trial.bound = problem_.mu[static_cast<std::size_t>(contact)] * std::max(trial.normal, 0.0);
  return trial;
}

void ConeMap::evaluate(const Numbers& r, const Numbers& u, Numbers& f) const {
  f.resize(r.size());
  for (int c = 0; c < problem_.num_contacts(); ++c) {
    const auto i = static_cast<std::size_t>(3 * c);
    const Trial trial = try_contact(c, r, u);
    const double share = trial.length <= trial.bound ? 1 : trial.bound / trial.length;
    f[i] = r[i] - std::max(trial.normal, 0.0);
    f[i + 1] = r[i + 1] - share * trial.across[0];
    f[i + 2] = r[i + 2] - share * trial.across[1];
  }
  for (int row = 3 * problem_.num_contacts(), k = 0; row < problem_.num_rows(); ++row, ++k) {
    const auto i = static_cast<std::size_t>(row), bound = static_cast<std::size_t>(k);
    f[i] = r[i] - std::clamp(try_bounded(row, r, u), problem_.low[bound], problem_.high[bound]);
  }
}

void ConeMap::add_speed(int row, double factor, double shift, double* to) const {
  const double* w = problem_.w.row(row);
  for (int j = 0; j < problem_.num_rows(); ++j) to[j] += factor * w[j];
  to[row] += factor * shift;
}

void ConeMap::differentiate_slide(int contact, const Trial& trial, double shift,
                                  DenseMatrix& jacobian) const {
  const int row = 3 * contact;
  const double share = trial.bound / trial.length, mu = problem_.mu[static_cast<std::size_t>(contact)];
  const double direction[2] = {trial.across[0] / trial.length, trial.across[1] / trial.length};
  for (int k = 0; k < 2; ++k) {
    double* to = jacobian.row(row + 1 + k);
    to[row + 1 + k] += 1;
    to[row] -= mu * direction[k];
    add_speed(row, mu * direction[k] * rho(row), shift, to);
    for (int other = 0; other < 2; ++other) {
      const double turn = share * ((k == other ? 1 : 0) - direction[k] * direction[other]);
      to[row + 1 + other] -= turn;
      add_speed(row + 1 + other, turn * rho(row + 1), shift, to);
    }
  }
}

void ConeMap::differentiate(const Numbers& r, const Numbers& u, double shift, DenseMatrix& jacobian) const {
  const int n = problem_.num_rows();
  jacobian.clear(n, n);
  for (int c = 0; c < problem_.num_contacts(); ++c) {
    const int row = 3 * c;
    const Trial trial = try_contact(c, r, u);
    if (trial.normal <= 0) {
      for (int k = 0; k < 3; ++k) jacobian.row(row + k)[row + k] = 1;
      continue;
    }
    add_speed(row, rho(row), shift, jacobian.row(row));
    if (trial.length > trial.bound) {
      differentiate_slide(c, trial, shift, jacobian);
    } else {
      for (int k = 1; k < 3; ++k) add_speed(row + k, rho(row + k), shift, jacobian.row(row + k));
    }
  }
  for (int row = 3 * problem_.num_contacts(), k = 0; row < n; ++row, ++k) {
    const double trial = try_bounded(row, r, u);
    const auto bound = static_cast<std::size_t>(k);
    if (trial < problem_.low[bound] || trial > problem_.high[bound]) {
      jacobian.row(row)[row] = 1;
    } else {
      add_speed(row, rho(row), shift, jacobian.row(row));
    }
  }
}

double length_of(const Numbers& numbers) {
  double square = 0;
  for (const double number : numbers) square += number * number;
  return std::sqrt(square);
}

void find_speeds(const ConeProblem& problem, const Numbers& r, Numbers& u) {
  u = problem.q;
  for (std::size_t i = 0; i < u.size(); ++i) {
    const double* w = problem.w.row(static_cast<int>(i));
    for (std::size_t j = 0; j < r.size(); ++j) u[i] += w[j] * r[j];
  }
}

}  // namespace pbmpi::solver
