#include "solver/newton/dense.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace pbmpi::solver {
namespace {

/// The row of the largest number in a column, from the diagonal down.
int find_pivot(const DenseMatrix& a, int column) {
  int pivot = column;
  for (int i = column + 1; i < a.num_rows(); ++i) {
    if (std::abs(a.row(i)[column]) > std::abs(a.row(pivot)[column])) pivot = i;
  }
  return pivot;
}

}  // namespace

bool solve_by_elimination(DenseMatrix& a, std::vector<double>& x) {
  const int n = a.num_rows();
  for (int k = 0; k < n; ++k) {
    const int pivot = find_pivot(a, k);
    double* top = a.row(k);
    if (pivot != k) {
      std::swap_ranges(top + k, top + n, a.row(pivot) + k);
      std::swap(x[static_cast<std::size_t>(k)], x[static_cast<std::size_t>(pivot)]);
    }
    if (!(std::abs(top[k]) > 0)) return false;
    for (int i = k + 1; i < n; ++i) {
      double* row = a.row(i);
      const double factor = row[k] / top[k];
      if (factor == 0) continue;
      for (int j = k + 1; j < n; ++j) row[j] -= factor * top[j];
      x[static_cast<std::size_t>(i)] -= factor * x[static_cast<std::size_t>(k)];
    }
  }
  for (int i = n - 1; i >= 0; --i) {
    const double* row = a.row(i);
    double sum = x[static_cast<std::size_t>(i)];
    for (int j = i + 1; j < n; ++j) sum -= row[j] * x[static_cast<std::size_t>(j)];
    x[static_cast<std::size_t>(i)] = sum / row[i];
  }
  return true;
}

bool CholeskyFactor::factor(DenseMatrix a) {
  constexpr double rounding = 1e-14;  // relative to a diagonal element, in sums of some hundred terms
  for (int j = 0; j < a.num_rows(); ++j) {
    double* row = a.row(j);
    const double before = row[j];
    for (int k = 0; k <= j; ++k) {
      const double* other = a.row(k);
      double sum = row[k];
      for (int i = 0; i < k; ++i) sum -= row[i] * other[i];
      if (k < j) {
        row[k] = sum / other[k];
      } else if (sum > rounding * before) {
        row[j] = std::sqrt(sum);
      } else {
        return false;
      }
    }
  }
  lower_ = std::move(a);
  return true;
}

void CholeskyFactor::forward(std::vector<double>& x) const {
  for (int i = 0; i < lower_.num_rows(); ++i) {
    const double* row = lower_.row(i);
    double sum = x[static_cast<std::size_t>(i)];
    for (int k = 0; k < i; ++k) sum -= row[k] * x[static_cast<std::size_t>(k)];
    x[static_cast<std::size_t>(i)] = sum / row[i];
  }
}

void CholeskyFactor::backward(std::vector<double>& x) const {
  for (int i = lower_.num_rows() - 1; i >= 0; --i) {
    const double* row = lower_.row(i);
    const double value = x[static_cast<std::size_t>(i)] / row[i];
    x[static_cast<std::size_t>(i)] = value;
    for (int k = 0; k < i; ++k) x[static_cast<std::size_t>(k)] -= row[k] * value;
  }
}

}  // namespace pbmpi::solver
