#include "solver/newton/row_system.h"

#include <algorithm>
#include <utility>

#include "model/islands.h"
#include "solver/newton/cone_solver.h"

namespace pbmpi::solver {
namespace {

double product(const SixVector& a, const SixVector& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

/// The numbers in a row of a matrix.
Numbers row_of(const DenseMatrix& matrix, int row) {
  return {matrix.row(row), matrix.row(row) + matrix.num_columns()};
}

/// The coupling of the other rows while the joints' rows hold, W = A - B R^-1 B^T.
class Condensed {
 public:
  /// `held`: R, [held][held]; `across`: B, [others][held]. False if R is singular.
  bool factor(DenseMatrix held, const DenseMatrix& across) {
    if (!factor_.factor(std::move(held))) return false;
    for (int i = 0; i < across.num_rows(); ++i) {
      halves_.push_back(row_of(across, i));
      factor_.forward(halves_.back());
    }
    return true;
  }
  void subtract_from(DenseMatrix& w) const {
    for (int i = 0; i < w.num_rows(); ++i) {
      for (int j = 0; j <= i; ++j) {
        w.row(i)[j] -= product_of(i, halves_[static_cast<std::size_t>(j)]);
        w.row(j)[i] = w.row(i)[j];
      }
    }
  }
  /// -B R^-1 u for one of the other rows, given L^-1 u.
  double carried(int other, const Numbers& half) const { return -product_of(other, half); }
  const CholeskyFactor& factors() const { return factor_; }
  /// x += L^-1 B^T change.
  void add(const Numbers& change, Numbers& x) const {
    for (std::size_t i = 0; i < change.size(); ++i) {
      for (std::size_t k = 0; k < x.size(); ++k) x[k] += halves_[i][k] * change[i];
    }
  }

 private:
  double product_of(int other, const Numbers& half) const {
    const Numbers& own = halves_[static_cast<std::size_t>(other)];
    double sum = 0;
    for (std::size_t k = 0; k < own.size(); ++k) sum += own[k] * half[k];
    return sum;
  }

  CholeskyFactor factor_;
  std::vector<Numbers> halves_;  ///< L^-1 B^T, [others][held]
};

}  // namespace

void RowSystem::start(std::vector<SixVector> twists) {
  twists_ = std::move(twists);
  rows_.clear();
  bounds_.clear();
}

int RowSystem::add(const SystemRow& row, const Bound& bound) {
  rows_.push_back(row);
  bounds_.push_back(bound);
  return static_cast<int>(rows_.size()) - 1;
}

int RowSystem::add_held(const SystemRow& row) { return add(row, {}); }

int RowSystem::add_bounded(const SystemRow& row, double low, double high) {
  return add(row, {Law::bounded, low, high, 0});
}

int RowSystem::add_contact(const std::array<SystemRow, 3>& rows, double mu) {
  const int first = add(rows[0], {Law::contact, 0, 0, mu});
  add(rows[1], {Law::contact, 0, 0, mu});
  add(rows[2], {Law::contact, 0, 0, mu});
  return first;
}

std::vector<RowSystem::Island> RowSystem::find_islands() const {
  model::DisjointSets connected(static_cast<int>(twists_.size()));
  for (const SystemRow& row : rows_) {
    if (row.a >= 0 && row.b >= 0) connected.unite(row.a, row.b);
  }
  std::vector<int> island_of(twists_.size(), -1);
  std::vector<Island> islands;
  for (std::size_t row = 0; row < rows_.size(); ++row) {
    const int body = rows_[row].a >= 0 ? rows_[row].a : rows_[row].b;
    if (body < 0) continue;
    int& island = island_of[static_cast<std::size_t>(connected.find(body))];
    if (island < 0) {
      island = static_cast<int>(islands.size());
      islands.emplace_back();
    }
    Island& into = islands[static_cast<std::size_t>(island)];
    const Law law = bounds_[row].law;
    std::vector<int>& rows =
        law == Law::held ? into.held : (law == Law::contact ? into.contacts : into.bounded);
    rows.push_back(static_cast<int>(row));
  }
  return islands;
}

double RowSystem::speed(const SystemRow& row) const {
  double sum = row.cfm * row.impulse - row.rhs;
  if (row.a >= 0) sum += product(row.jacobian_a, twist(row.a));
  if (row.b >= 0) sum += product(row.jacobian_b, twist(row.b));
  return sum;
}

double RowSystem::coupling(const SystemRow& row, const SystemRow& other) {
  double sum = 0;
  if (row.a >= 0 && row.a == other.a) sum += product(row.jacobian_a, other.response_a);
  if (row.a >= 0 && row.a == other.b) sum += product(row.jacobian_a, other.response_b);
  if (row.b >= 0 && row.b == other.a) sum += product(row.jacobian_b, other.response_a);
  if (row.b >= 0 && row.b == other.b) sum += product(row.jacobian_b, other.response_b);
  return sum;
}

DenseMatrix RowSystem::couplings(std::span<const int> rows, std::span<const int> others) const {
  DenseMatrix matrix(static_cast<int>(rows.size()), static_cast<int>(others.size()));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    double* to = matrix.row(static_cast<int>(i));
    const SystemRow& row = rows_[static_cast<std::size_t>(rows[i])];
    for (std::size_t j = 0; j < others.size(); ++j) {
      to[j] = coupling(row, rows_[static_cast<std::size_t>(others[j])]);
      if (rows[i] == others[j]) to[j] += row.cfm;
    }
  }
  return matrix;
}

void RowSystem::change(int row, double by) {
  SystemRow& changed = rows_[static_cast<std::size_t>(row)];
  changed.impulse += by;
  for (std::size_t i = 0; i < 6; ++i) {
    if (changed.a >= 0) twists_[static_cast<std::size_t>(changed.a)][i] += changed.response_a[i] * by;
    if (changed.b >= 0) twists_[static_cast<std::size_t>(changed.b)][i] += changed.response_b[i] * by;
  }
}

void RowSystem::solve(const Island& island) {
  std::vector<int> others = island.contacts;
  others.insert(others.end(), island.bounded.begin(), island.bounded.end());
  if (others.size() > most_bounded_rows || others.size() + island.held.size() > most_rows) return;
  Condensed condensed;
  if (!condensed.factor(couplings(island.held, island.held), couplings(others, island.held))) return;

  Numbers half;  // L^-1 u of the held rows
  for (const int row : island.held) half.push_back(speed(rows_[static_cast<std::size_t>(row)]));
  condensed.factors().forward(half);

  ConeProblem problem;
  problem.w = couplings(others, others);
  condensed.subtract_from(problem.w);
  Numbers before;
  for (const int row : others) before.push_back(impulse(row));
  for (std::size_t i = 0; i < others.size(); ++i) {
    const double* w = problem.w.row(static_cast<int>(i));
    double q =
        speed(rows_[static_cast<std::size_t>(others[i])]) + condensed.carried(static_cast<int>(i), half);
    for (std::size_t j = 0; j < others.size(); ++j) q -= w[j] * before[j];
    problem.q.push_back(q);
  }
  for (std::size_t i = 0; i < island.contacts.size(); i += 3)
    problem.mu.push_back(bounds_[static_cast<std::size_t>(island.contacts[i])].mu);
  for (const int row : island.bounded) {
    problem.low.push_back(bounds_[static_cast<std::size_t>(row)].low);
    problem.high.push_back(bounds_[static_cast<std::size_t>(row)].high);
  }
  Numbers after = before;
  ConeSolver(problem).solve(after);

  Numbers changes;
  for (std::size_t i = 0; i < others.size(); ++i) changes.push_back(after[i] - before[i]);
  condensed.add(changes, half);
  condensed.factors().backward(half);
  for (std::size_t i = 0; i < others.size(); ++i) change(others[i], changes[i]);
  for (std::size_t i = 0; i < island.held.size(); ++i) change(island.held[i], -half[i]);
}

/// Solves each island twice: the second pass removes what rounding left in the first.
void RowSystem::solve() {
  for (const Island& island : find_islands()) {
    for (int pass = 0; pass < 2; ++pass) solve(island);
  }
}

}  // namespace pbmpi::solver
