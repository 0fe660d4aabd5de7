/// Small symmetric positive definite matrices in lanes.
#pragma once

#include <limits>

#include "solver/lanes/lanes.h"

namespace pbmpi::solver {

/// Factors A = L D L^T of a matrix of up to `most` rows; n: its number of rows.
template <class T, int most>
struct alignas(sizeof(typename T::V)) SymmetricFactor {
  using V = typename T::V;

  V lower[most][most];  ///< L, D on the diagonal, D L^T above it
  V inverse_d[most];

  /// `a`: [n][n], of which the lower triangle is read.
  template <int n = most>
  PBMPI_LANES void factor(const V (&a)[most][most]) {
    eliminate<n, n>(a);
  }
  /// Eliminates the first `pivots` unknowns of n. What is left of the others is the Schur complement, in the
  /// lower triangle from (pivots, pivots) on. A pivot of which rounding leaves nothing is taken as that
  /// rounding.
  template <int pivots, int n = most>
  PBMPI_LANES void eliminate(const V (&a)[most][most]) {
    for (int j = 0; j < n; ++j) {
      const int before = j < pivots ? j : pivots;
      for (int i = j; i < n; ++i) {
        V sum = a[i][j];
        for (int k = 0; k < before; ++k) sum -= lower[i][k] * lower[k][j];
        lower[i][j] = sum;
      }
      if (j >= pivots) continue;
      lower[j][j] =
          T::max(lower[j][j], a[j][j] * T::broadcast(8 * std::numeric_limits<typename T::Scalar>::epsilon()));
      inverse_d[j] = T::broadcast(1) / lower[j][j];
      for (int i = j + 1; i < n; ++i) {
        lower[j][i] = lower[i][j];
        lower[i][j] = lower[i][j] * inverse_d[j];
      }
    }
  }
  /// x = A^-1 x, [n].
  template <int n = most>
  PBMPI_LANES void solve(V* x) const {
    forward<n>(x);
    for (int i = n - 2; i >= 0; --i) back(i, n, x);
  }
  /// The first half of solve(): x = D^-1 L^-1 x for the first `pivots`, L^-1 x for the others.
  template <int pivots, int n = pivots>
  PBMPI_LANES void forward(V* x) const {
    for (int i = 1; i < n; ++i) {
      for (int k = 0; k < i && k < pivots; ++k) x[i] -= lower[i][k] * x[k];
    }
    for (int i = 0; i < pivots; ++i) x[i] *= inverse_d[i];
  }
  /// The second half of solve() for x[i], after x[i + 1] to x[n - 1].
  PBMPI_LANES void back(int i, int n, V* x) const {
    for (int k = i + 1; k < n; ++k) x[i] -= lower[k][i] * x[k];
  }
};

}  // namespace pbmpi::solver
