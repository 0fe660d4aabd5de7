/// Dense matrices and their factors. Plain loops, whose sums have the same order on every machine: Eigen's
/// blocks, and hence its last bits, depend on the cache sizes.
#pragma once

#include <cstddef>
#include <vector>

namespace pbmpi::solver {

/// A matrix by rows, [num_rows][num_columns].
class DenseMatrix {
 public:
  DenseMatrix() = default;
  DenseMatrix(int num_rows, int num_columns) { clear(num_rows, num_columns); }

  /// Sets the size, and all numbers to zero.
  void clear(int num_rows, int num_columns) {
    num_rows_ = num_rows;
    num_columns_ = num_columns;
    numbers_.assign(static_cast<std::size_t>(num_rows) * static_cast<std::size_t>(num_columns), 0);
  }
  int num_rows() const { return num_rows_; }
  int num_columns() const { return num_columns_; }
  double* row(int i) { return numbers_.data() + at(i); }
  const double* row(int i) const { return numbers_.data() + at(i); }

 private:
  std::size_t at(int i) const { return static_cast<std::size_t>(i) * static_cast<std::size_t>(num_columns_); }

  int num_rows_ = 0, num_columns_ = 0;
  std::vector<double> numbers_;
};

/// x = A^-1 x by elimination with partial pivoting, which overwrites A. False if A is singular.
bool solve_by_elimination(DenseMatrix& a, std::vector<double>& x);

/// The factor A = L L^T of a symmetric positive definite matrix.
class CholeskyFactor {
 public:
  /// Reads the lower triangle. False if rounding is as large as the remainder of a diagonal element.
  bool factor(DenseMatrix a);
  /// x = L^-1 x and x = L^-T x.
  void forward(std::vector<double>& x) const;
  void backward(std::vector<double>& x) const;

 private:
  DenseMatrix lower_;
};

}  // namespace pbmpi::solver
