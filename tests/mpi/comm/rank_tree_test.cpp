#include "mpi/comm/tree_gather.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace pbmpi::mpi {
namespace {

/// Collects `rank` and the ranks below it by following its children, in the order in which their data are
/// handed on.
void collect(const RankTree& tree, int rank, std::vector<int>& ranks) {
  ranks.push_back(rank);
  for (const int child : tree.children(rank)) collect(tree, child, ranks);
}

TEST(RankTree, hands_on_every_rank_once_and_in_order) {
  for (const int radix : {2, 3, 4, 8, 32}) {
    for (int num_ranks = 1; num_ranks <= 70; ++num_ranks) {
      const RankTree tree(num_ranks, radix);
      std::vector<int> ranks;
      collect(tree, 0, ranks);
      ASSERT_EQ(std::ssize(ranks), num_ranks) << radix;
      EXPECT_TRUE(std::ranges::is_sorted(ranks)) << num_ranks << " ranks, radix " << radix;
    }
  }
}

TEST(RankTree, has_parents_that_fit_children_and_ranges_that_fit_subtrees) {
  for (const int radix : {2, 3, 32}) {
    for (const int num_ranks : {1, 2, 7, 33, 64, 1000}) {
      const RankTree tree(num_ranks, radix);
      EXPECT_EQ(tree.parent(0), -1);
      for (int rank = 0; rank < num_ranks; ++rank) {
        for (const int child : tree.children(rank)) EXPECT_EQ(tree.parent(child), rank);
        std::vector<int> below;
        collect(tree, rank, below);
        EXPECT_EQ(tree.end(rank) - rank, std::ssize(below)) << rank << " of " << num_ranks;
      }
    }
  }
}

TEST(RankTree, is_the_binomial_tree_with_radix_2) {
  const RankTree tree(8, 2);  // Thakur, Rabenseifner and Gropp 2005, Figure 1
  EXPECT_EQ(tree.children(0), (std::vector<int>{1, 2, 4}));
  EXPECT_EQ(tree.children(4), (std::vector<int>{5, 6}));
  EXPECT_EQ(tree.children(6), (std::vector<int>{7}));
  EXPECT_EQ(tree.depth(7), 3);
  EXPECT_EQ(tree.depth(4), 1);
}

TEST(RankTree, is_flat_up_to_its_radix_and_as_deep_as_the_number_of_ranks_has_digits) {
  EXPECT_EQ(RankTree(32).children(0).size(), 31u);
  EXPECT_EQ(RankTree(32).depth(31), 1);
  EXPECT_EQ(RankTree(33).children(0).size(), 32u);
  EXPECT_EQ(RankTree(64).depth(63), 2);
  EXPECT_EQ(RankTree(1024).children(0).size(), 62u);
  EXPECT_EQ(RankTree(1024).depth(1023), 2);
  EXPECT_EQ(RankTree(131072).depth(131071), 4);
  EXPECT_EQ(RankTree(131072).children(0).size(), 31u * 3 + 3);
}

}  // namespace
}  // namespace pbmpi::mpi
