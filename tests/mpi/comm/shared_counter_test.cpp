#include "mpi/comm/shared_counter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <span>
#include <vector>

namespace pbmpi::mpi {
namespace {

TEST(SharedCounter, hands_out_each_number_once_to_whoever_asks) {
  constexpr std::int64_t num_numbers = 1000;
  const Communicator world = Communicator::world();
  SharedCounter counter(world);
  std::vector<std::int64_t> own;
  for (std::int64_t number = counter.next(); number < num_numbers; number = counter.next())
    own.push_back(number);
  EXPECT_TRUE(std::ranges::is_sorted(own));
  std::vector<std::int64_t> all = world.allgatherv(std::span<const std::int64_t>(own));
  std::ranges::sort(all);
  ASSERT_EQ(std::ssize(all), num_numbers);
  for (std::int64_t number = 0; number < num_numbers; ++number)
    EXPECT_EQ(all[static_cast<std::size_t>(number)], number);
  world.barrier();
  EXPECT_EQ(counter.value(), num_numbers + world.size()) << "each rank has asked once too often";
}

TEST(SharedCounter, leaves_numbers_out_for_all_ranks) {
  const Communicator world = Communicator::world();
  SharedCounter counter(world);
  if (world.is_root()) counter.skip(10);
  world.barrier();
  EXPECT_GE(counter.next(), 10);
}

TEST(SharedCounter, counts_for_one_rank_without_mpi) {
  SharedCounter counter{Communicator()};
  EXPECT_EQ(counter.next(), 0);
  EXPECT_EQ(counter.next(), 1);
  EXPECT_EQ(counter.value(), 2);
}

}  // namespace
}  // namespace pbmpi::mpi
