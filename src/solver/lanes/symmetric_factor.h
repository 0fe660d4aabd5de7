/// Small symmetric positive definite matrices in lanes.
#pragma once

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
    for (int j = 0; j < n; ++j) {
      V d = a[j][j];
      for (int k = 0; k < j; ++k) {
        lower[k][j] = lower[j][k] * lower[k][k];
        d -= lower[j][k] * lower[k][j];
      }
      lower[j][j] = d;
      inverse_d[j] = T::broadcast(1) / d;
      for (int i = j + 1; i < n; ++i) {
        V sum = a[i][j];
        for (int k = 0; k < j; ++k) sum -= lower[i][k] * lower[k][j];
        lower[i][j] = sum * inverse_d[j];
      }
    }
  }
  /// x = A^-1 x, [n].
  template <int n = most>
  PBMPI_LANES void solve(V* x) const {
    for (int i = 1; i < n; ++i) {
      for (int k = 0; k < i; ++k) x[i] -= lower[i][k] * x[k];
    }
    for (int i = 0; i < n; ++i) x[i] *= inverse_d[i];
    for (int i = n - 2; i >= 0; --i) {
      for (int k = i + 1; k < n; ++k) x[i] -= lower[k][i] * x[k];
    }
  }
};

}  // namespace pbmpi::solver
