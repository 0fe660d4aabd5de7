#include "mpi/comm/rank_tree.h"

#include <algorithm>

#include "core/error.h"

namespace pbmpi::mpi {

RankTree::RankTree(int num_ranks, int radix) : num_ranks_(num_ranks), radix_(radix) {
  core::require_invariant(num_ranks >= 1 && radix >= 2, "RankTree: num_ranks >= 1, radix >= 2");
}

long long RankTree::place(int rank) const {
  long long place = 1;
  if (rank == 0) {
    while (place < num_ranks_) place *= radix_;
    return place;
  }
  while (rank / place % radix_ == 0) place *= radix_;
  return place;
}

int RankTree::parent(int rank) const {
  if (rank == 0) return -1;
  const long long digit = place(rank);
  return static_cast<int>(rank - rank / digit % radix_ * digit);
}

std::vector<int> RankTree::children(int rank) const {
  std::vector<int> children;
  for (long long digit = 1; digit < place(rank); digit *= radix_) {
    for (int times = 1; times < radix_ && rank + times * digit < num_ranks_; ++times)
      children.push_back(static_cast<int>(rank + times * digit));
  }
  return children;
}

int RankTree::end(int rank) const {
  return static_cast<int>(std::min<long long>(rank + place(rank), num_ranks_));
}

int RankTree::depth(int rank) const {
  int depth = 0;
  for (; rank != 0; rank = parent(rank)) ++depth;
  return depth;
}

}  // namespace pbmpi::mpi
