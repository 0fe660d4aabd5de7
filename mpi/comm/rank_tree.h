/// Which rank hands its data on to which: a tree over the ranks, as pure data.
#pragma once

#include <vector>

namespace pbmpi::mpi {

/// A tree of ranks with root 0, in which the descendants of a rank are numbered right after it without a gap
/// (a k-nomial tree: Thakur, Rabenseifner and Gropp, "Optimization of collective communication operations in
/// MPICH", IJHPCA 19, 2005, describe it with radix 2). To get the parent of a rank, write its number in the
/// radix and set its lowest nonzero digit to 0. A tree of no more ranks than its radix is flat: all are
/// children of root.
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
  /// One past the last descendant of `rank`: the ranks from `rank` up to this one are `rank` and those below
  /// it.
  int end(int rank) const;
  /// Messages on the way from a rank to root; 0 for root.
  int depth(int rank) const;

 private:
  /// The place value of the lowest nonzero digit of `rank`; for root a power of the radix that no rank
  /// reaches.
  long long place(int rank) const;

  int num_ranks_;
  int radix_;
};

}  // namespace pbmpi::mpi
