#include "core/hash.h"

#include <bit>
#include <limits>
#include <string_view>

#include <gtest/gtest.h>

namespace pbmpi::core {
namespace {

/// FNV-1a byte by byte, as its authors specify it.
std::uint64_t fnv1a(std::string_view bytes) {
  std::uint64_t hash = 14695981039346656037ull;
  for (const char byte : bytes) hash = (hash ^ static_cast<unsigned char>(byte)) * 1099511628211ull;
  return hash;
}

TEST(Hash64, is_fnv1a_over_the_bytes_of_its_words) {
  ASSERT_EQ(fnv1a("foobar"), 0x85944171f73967e8ull);  // the authors' test vector
  EXPECT_EQ(Hash64().value(), fnv1a(""));
  Hash64 hash;
  hash.add(0x6867666564636261ull);  // "abcdefgh", lowest byte first
  EXPECT_EQ(hash.value(), fnv1a("abcdefgh"));
}

TEST(Hash64, of_doubles_goes_by_their_bits) {
  const auto hash_of = [](double value) {
    Hash64 hash;
    hash.add(&value, 1);
    return hash.value();
  };
  EXPECT_NE(hash_of(0.0), hash_of(-0.0));
  EXPECT_NE(hash_of(1.0), hash_of(1.0 + std::numeric_limits<double>::epsilon()));
  EXPECT_EQ(hash_of(1.5), hash_of(1.5));
  const double quiet = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(hash_of(quiet), hash_of(std::bit_cast<double>(std::bit_cast<std::uint64_t>(quiet) ^ 1)));
}

TEST(Hash64, depends_on_the_order) {
  Hash64 forward, backward;
  forward.add(1);
  forward.add(2);
  backward.add(2);
  backward.add(1);
  EXPECT_NE(forward.value(), backward.value());
}

TEST(ToHex, writes_16_digits) {
  EXPECT_EQ(to_hex(0), "0000000000000000");
  EXPECT_EQ(to_hex(0xfedcba9876543210ull), "fedcba9876543210");
}

}  // namespace
}  // namespace pbmpi::core
