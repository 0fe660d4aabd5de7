/// Solves the rows of a world, each island as one system.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "solver/newton/cone_problem.h"

namespace pbmpi::solver {

/// Velocity of a body: linear [m/s] before angular [rad/s], world frame; or a row's coefficients for it.
using SixVector = std::array<double, 6>;

/// J v + cfm p - rhs = 0, with the impulse p [N s or N m s], and M^-1 J^T p added to the velocities.
struct SystemRow {
  int a = -1, b = -1;  ///< bodies of the system; -1: the environment
  SixVector jacobian_a{}, jacobian_b{};
  SixVector response_a{}, response_b{};  ///< M^-1 J^T
  double rhs = 0, cfm = 0, impulse = 0;  ///< [m/s or rad/s], [1/kg ...], [N s ...]
};

/// Bodies and rows, changed in place by solve().
class RowSystem {
 public:
  /// Islands with more rows than this, or more contact and bounded rows, stay as they are: the work grows
  /// with the cube.
  static constexpr int most_rows = 2000, most_bounded_rows = 400;

  /// Starts a new system. `twists`: [num_bodies].
  void start(std::vector<SixVector> twists);
  // Rows keep the order in which they are added, which decides the last bits. Each call returns the index of
  // its (first) row.
  int add_held(const SystemRow& row);
  int add_bounded(const SystemRow& row, double low, double high);
  /// Adds a normal row, and two across it.
  int add_contact(const std::array<SystemRow, 3>& rows, double mu);

  /// Brings each island to its solution, as closely as ConeSolver does; an island's bits depend on that
  /// island alone.
  void solve();

  const SixVector& twist(int body) const { return twists_[static_cast<std::size_t>(body)]; }
  double impulse(int row) const { return rows_[static_cast<std::size_t>(row)].impulse; }

 private:
  enum class Law : char { held, bounded, contact };
  /// What applies to a row in addition to its equation.
  struct Bound {
    Law law = Law::held;
    double low = 0, high = 0, mu = 0;
  };
  /// Rows of an island by law, each ascending.
  struct Island {
    std::vector<int> held, contacts, bounded;
  };

  int add(const SystemRow& row, const Bound& bound);
  std::vector<Island> find_islands() const;
  void solve(const Island& island);
  double speed(const SystemRow& row) const;
  /// J_row M^-1 J_other^T.
  static double coupling(const SystemRow& row, const SystemRow& other);
  DenseMatrix couplings(std::span<const int> rows, std::span<const int> others) const;
  void change(int row, double by);

  std::vector<SixVector> twists_;
  std::vector<SystemRow> rows_;
  std::vector<Bound> bounds_;  ///< of rows_
};

}  // namespace pbmpi::solver
