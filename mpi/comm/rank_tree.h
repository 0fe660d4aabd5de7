/// Who hands its data on to whom: a tree over the ranks, as pure data.
#pragma once

#include <vector>

namespace pbmpi::mpi {

/// A tree of ranks with root 0, in which the ranks below a rank follow it without a gap (a k-nomial tree:
/// Thakur, Rabenseifner and Gropp, "Optimization of collective communication operations in MPICH", IJHPCA 19,
/// 2005, have it with radix 2). The parent of a rank is its number with the lowest digit that is not 0 set to
/// 0, written with the radix. A tree of no more ranks than its radix is flat: all are children of root.
class RankTree {
 public:
  /// Root has at most 31 children a level, and 1,024 ranks have two levels (docs/scaling.md).
  static constexpr int usual_radix = 32;

  /// `num_ranks` >= 1, `radix` >= 2.
  explicit RankTree(int num_ranks, int radix = usual_radix);

  int num_ranks() const { return num_ranks_; }
  /// -1 for root.
  int parent(int rank) const;
  /// Ascending.
  std::vector<int> children(int rank) const;
  /// The ranks from `rank` on, up to this one, are those below it and the rank itself.
  int end(int rank) const;
  /// Messages on the way from a rank to root; 0 for root.
  int depth(int rank) const;

 private:
  /// What the lowest digit of `rank` that is not 0 counts; for root a power of the radix that no rank
  /// reaches.
  long long place(int rank) const;

  int num_ranks_;
  int radix_;
};

}  // namespace pbmpi::mpi
