#include "core/random.h"

#include <set>

#include <gtest/gtest.h>

namespace pbmpi::core {
namespace {

TEST(Mix64, gives_splitmix64s_published_sequence) {
  // Seed 1234567, as in the generator's published test vectors.
  constexpr std::uint64_t gamma = 0x9e3779b97f4a7c15ull;
  EXPECT_EQ(mix64(1234567), 6457827717110365317ull);
  EXPECT_EQ(mix64(1234567 + gamma), 3203168211198807973ull);
  EXPECT_EQ(mix64(1234567 + 2 * gamma), 9817491932198370423ull);
}

TEST(MixKey, tells_neighbouring_keys_apart_also_in_the_low_word) {
  std::set<std::uint64_t> keys, low_words;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    for (std::uint64_t world = 0; world < 10; ++world) {
      for (std::uint64_t step = 0; step < 10; ++step) {
        const std::uint64_t key = mix_key(seed, world, step);
        keys.insert(key);
        low_words.insert(key & 0xffffffff);  // the part that ODE's generator uses
      }
    }
  }
  EXPECT_EQ(keys.size(), 1000u);
  EXPECT_EQ(low_words.size(), 1000u);
}

TEST(ToUnit, covers_zero_to_below_one) {
  EXPECT_EQ(to_unit(0), 0);
  EXPECT_LT(to_unit(~0ull), 1);
  EXPECT_EQ(to_unit(1ull << 63), 0.5);
}

TEST(ToUnit, of_mixed_words_has_the_mean_of_a_uniform_number) {
  double sum = 0;
  constexpr int count = 10000;
  for (int i = 0; i < count; ++i) sum += to_unit(mix64(static_cast<std::uint64_t>(i)));
  EXPECT_NEAR(sum / count, 0.5, 5 * 0.2887 / 100);  // five standard errors of the mean
}

}  // namespace
}  // namespace pbmpi::core
