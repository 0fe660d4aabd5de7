#include "mpi/comm/communicator.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "core/error.h"
#include "mpi/comm/session.h"

namespace pbmpi::mpi {
namespace {

/// 12 bytes: sent as bytes, not as words.
struct Odd {
  int a = 0, b = 0, c = 0;
  bool operator==(const Odd&) const = default;
};

/// Checks that hold for any communicator, including the null one (of one rank).
void expect_collectives_work(const Communicator& comm) {
  const int rank = comm.rank();
  const int size = comm.size();

  std::vector<double> values = {rank + 0.5, rank + 1.5};
  comm.bcast(std::span(values), size - 1);
  EXPECT_EQ(values, (std::vector<double>{size - 0.5, size + 0.5}));

  std::string text = comm.is_root() ? std::string("a\0b", 3) : "something longer";
  comm.bcast_string(text);
  EXPECT_EQ(text, std::string("a\0b", 3));

  const std::vector<Odd> odds = comm.allgather(Odd{rank, 2 * rank, 3 * rank});
  ASSERT_EQ(std::ssize(odds), size);
  for (int r = 0; r < size; ++r) EXPECT_EQ(odds[r], (Odd{r, 2 * r, 3 * r}));

  // Rank r gives r values r, so that rank 0 gives none.
  const std::vector<int> mine(rank, rank);
  const std::vector<int> all = comm.allgatherv(std::span<const int>(mine));
  ASSERT_EQ(std::ssize(all), size * (size - 1) / 2);
  EXPECT_TRUE(std::is_sorted(all.begin(), all.end()));
  for (int r = 0; r < size; ++r) EXPECT_EQ(std::count(all.begin(), all.end(), r), r);

  std::vector<std::int64_t> sums = {rank + 1, -rank};
  comm.allreduce(sums, Reduce::sum);
  EXPECT_EQ(sums, (std::vector<std::int64_t>{size * (size + 1) / 2, -size * (size - 1) / 2}));
  std::vector<double> lowest = {10.0 - rank};
  comm.allreduce(lowest, Reduce::min);
  EXPECT_EQ(lowest[0], 10.0 - (size - 1));
  std::vector<std::uint64_t> highest = {~std::uint64_t{0} - static_cast<std::uint64_t>(rank)};
  comm.allreduce(highest, Reduce::max);
  EXPECT_EQ(highest[0], ~std::uint64_t{0});
}

TEST(Communicator, world_carries_every_collective) { expect_collectives_work(Communicator::world()); }

TEST(Communicator, dup_carries_every_collective) { expect_collectives_work(Communicator::world().dup()); }

TEST(Communicator, split_makes_a_communicator_of_each_group_in_the_order_of_the_ranks) {
  const Communicator world = Communicator::world();
  for (int num_groups = 1; num_groups <= 3; ++num_groups) {
    const int group = world.rank() % num_groups;
    const Communicator part = world.split(group);
    EXPECT_EQ(part.rank(), world.rank() / num_groups);
    EXPECT_EQ(part.size(), (world.size() - group + num_groups - 1) / num_groups);
    expect_collectives_work(part);
    for (const int rank : part.allgather(world.rank())) EXPECT_EQ(rank % num_groups, group);
  }
  EXPECT_TRUE(Communicator().split(1).is_null());
}

TEST(Communicator, dup_of_a_handle_carries_every_collective_and_returns_its_errors) {
  const Communicator copy = Communicator::dup_of(Communicator::world().fortran_handle());
  expect_collectives_work(copy);
  const int value = 1;
  EXPECT_THROW(copy.send(std::span(&value, 1), copy.size()), core::RunError);
  EXPECT_THROW(Communicator::dup_of(Communicator().fortran_handle()), core::InputError);
}

TEST(Communicator, null_acts_as_one_rank) {
  const Communicator null;
  EXPECT_TRUE(null.is_null());
  EXPECT_EQ(null.rank(), 0);
  EXPECT_EQ(null.size(), 1);
  EXPECT_TRUE(null.is_root());
  null.barrier();
  expect_collectives_work(null);
  EXPECT_TRUE(null.dup().is_null());
  EXPECT_NE(null.fortran_handle(), Communicator::world().fortran_handle());
}

TEST(Communicator, send_and_recv_pass_values_round_a_ring) {
  const Communicator comm = Communicator::world();
  if (comm.size() == 1) GTEST_SKIP() << "a ring needs two ranks";
  const int next = (comm.rank() + 1) % comm.size();
  const int last = (comm.rank() + comm.size() - 1) % comm.size();
  std::vector<double> token = {0.0};
  if (comm.is_root()) comm.send(std::span<const double>(token), next);
  comm.recv(std::span(token), last);
  token[0] += 1;
  if (!comm.is_root()) comm.send(std::span<const double>(token), next);
  EXPECT_EQ(token[0], comm.is_root() ? comm.size() : comm.rank());
}

TEST(Communicator, recv_refuses_a_message_of_another_length) {
  const Communicator comm = Communicator::world();
  if (comm.size() == 1) GTEST_SKIP() << "needs two ranks";
  std::vector<double> values(3, 1.0);
  if (comm.rank() == 0) comm.send(std::span<const double>(values), 1);
  if (comm.rank() != 1) return;
  values.resize(5);
  EXPECT_THROW(comm.recv(std::span(values), 0), core::RunError);
}

TEST(Communicator, a_failed_call_says_which_call_and_rank_and_what_mpi_means) {
  const Communicator comm = Communicator::world();
  double value = 0;
  try {
    comm.bcast_value(value, comm.size());  // no such root: MPI refuses before it communicates
    FAIL() << "no error";
  } catch (const core::RunError& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find("MPI_Bcast on rank " + std::to_string(comm.rank())), std::string::npos) << message;
    EXPECT_NE(message.find("MPI_ERR_ROOT"), std::string::npos) << message;
  }
}

TEST(Communicator, move_leaves_null_behind) {
  Communicator first = Communicator::world().dup();
  const int handle = first.fortran_handle();
  const Communicator second = std::move(first);
  EXPECT_TRUE(first.is_null());  // NOLINT(bugprone-use-after-move): what is tested
  EXPECT_EQ(second.fortran_handle(), handle);
}

TEST(GatherLayout, refuses_what_mpi_cannot_count) {
  const std::vector<std::int64_t> counts = {1 << 30, 1 << 30};  // 2^31, one more than an int holds
  EXPECT_THROW(GatherLayout::packed(counts), core::RunError);
}

TEST(HostNames, gives_one_name_a_rank) {
  const Communicator comm = Communicator::world();
  const std::vector<std::string> hosts = host_names(comm);
  ASSERT_EQ(std::ssize(hosts), comm.size());
  for (const std::string& host : hosts) EXPECT_FALSE(host.empty());
  EXPECT_EQ(host_names(Communicator()).size(), 1u);
}

TEST(LibraryVersion, is_one_line) {
  EXPECT_FALSE(library_version().empty());
  EXPECT_EQ(library_version().find('\n'), std::string::npos);
}

}  // namespace
}  // namespace pbmpi::mpi
