#include "core/instruction_counter.h"

#include <gtest/gtest.h>

namespace pbmpi::core {
namespace {

/// At least two instructions per round; the compiler must not know what the sum is used for.
std::uint64_t spin(int rounds) {
  volatile std::uint64_t seed = 1;
  std::uint64_t sum = seed;
  for (int i = 0; i < rounds; ++i) sum = sum * 6364136223846793005u + seed;
  return sum;
}

std::int64_t count(InstructionCounter& counter, int rounds) {
  counter.start();
  const std::uint64_t sum = spin(rounds);
  const std::int64_t instructions = counter.stop();
  EXPECT_NE(sum, 0u);
  return instructions;
}

TEST(InstructionCounter, counts_in_proportion_or_says_that_it_cannot) {
  InstructionCounter counter;
  const std::int64_t few = count(counter, 10'000), many = count(counter, 1'010'000);
  if (!counter.available()) {
    EXPECT_EQ(name_of(counter.source()), "none");
    EXPECT_EQ(few, -1);
    EXPECT_EQ(many, -1);
    return;
  }
  EXPECT_GE(few, 20'000);
  // Start and stop are in both; reading a processor's counter may add some thousand instructions to either.
  EXPECT_NEAR(static_cast<double>(many - few), 100.0 * static_cast<double>(few),
              0.5 * static_cast<double>(many));
}

}  // namespace
}  // namespace pbmpi::core
