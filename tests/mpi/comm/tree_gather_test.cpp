#include "mpi/comm/tree_gather.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace pbmpi::mpi {
namespace {

/// How many numbers rank r has: none, few, or more than a piece of 64 bytes.
std::int64_t count_of(int rank) { return rank % 3 == 1 ? 0 : 3 + 11 * rank; }

std::vector<double> numbers_of(int rank) {
  std::vector<double> numbers;
  for (std::int64_t i = 0; i < count_of(rank); ++i)
    numbers.push_back(1000.0 * rank + 0.1 * static_cast<double>(i));
  return numbers;
}

TEST(TreeGather, brings_the_same_bits_by_every_tree_and_length_of_piece) {
  const Communicator comm = Communicator::world();
  std::vector<std::int64_t> bytes;
  std::vector<double> expected;
  for (int rank = 0; rank < comm.size(); ++rank) {
    bytes.push_back(8 * count_of(rank));
    const std::vector<double> numbers = numbers_of(rank);
    expected.insert(expected.end(), numbers.begin(), numbers.end());
  }
  const std::vector<double> own = numbers_of(comm.rank());
  for (const int radix : {2, 3, 32}) {
    for (const std::size_t piece : {std::size_t{1}, std::size_t{20}, std::size_t{64}, std::size_t{1} << 20}) {
      TreeGather gather(comm, radix, piece);
      gather.set_shares(bytes);
      std::vector<double> all(comm.is_root() ? expected.size() : 0);
      gather.gather(std::span<const double>(own), std::span(all));
      if (!comm.is_root()) continue;
      EXPECT_EQ(all, expected) << "radix " << radix << ", pieces of " << piece;
    }
  }
}

TEST(TreeGather, counts_what_each_rank_hands_on) {
  const Communicator comm = Communicator::world();
  const std::vector<std::int64_t> bytes(static_cast<std::size_t>(comm.size()), 100);
  const std::vector<std::byte> own(100);
  const RankTree tree(comm.size(), 2);
  TreeGather gather(comm, 2, 64);
  gather.set_shares(bytes);
  std::vector<std::byte> all(comm.is_root() ? 100 * bytes.size() : 0);
  gather.gather(std::span<const std::byte>(own), std::span(all));
  const core::Traffic traffic = gather.take_traffic();
  const std::int64_t below = comm.is_root() ? 0 : 100 * (tree.end(comm.rank()) - comm.rank());
  EXPECT_EQ(traffic.bytes, below);
  EXPECT_EQ(traffic.messages, (below + 63) / 64);
  EXPECT_EQ(gather.take_traffic().messages, 0);
}

TEST(TreeGather, gathers_rows_of_which_ranks_have_unequal_numbers) {
  struct Row {
    std::int64_t rank, i;
  };
  const Communicator comm = Communicator::world();
  std::vector<Row> own;
  for (std::int64_t i = 0; i < count_of(comm.rank()); ++i) own.push_back({comm.rank(), i});
  const std::vector<Row> all = gather_rows(comm, std::span<const Row>(own));
  if (!comm.is_root()) {
    EXPECT_TRUE(all.empty());
    return;
  }
  std::size_t next = 0;
  for (int rank = 0; rank < comm.size(); ++rank) {
    for (std::int64_t i = 0; i < count_of(rank); ++i, ++next) {
      ASSERT_LT(next, all.size());
      EXPECT_EQ(all[next].rank, rank);
      EXPECT_EQ(all[next].i, i);
    }
  }
  EXPECT_EQ(next, all.size());
}

TEST(TreeGather, runs_without_mpi_on_the_null_communicator) {
  const std::vector<std::int64_t> own = {7, -3};
  EXPECT_EQ(gather_rows(Communicator(), std::span<const std::int64_t>(own)), own);
}

}  // namespace
}  // namespace pbmpi::mpi
