#include "core/system/seal.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <vector>

namespace pbmpi::core {
namespace {

TEST(Seal, of_bytes_is_intact_until_a_bit_of_them_or_of_the_seal_changes) {
  for (const std::size_t length : {0u, 1u, 8u, 13u}) {
    std::vector<std::byte> image(length, std::byte{5});
    add_seal(image);
    const auto inside = sealed_part(image);
    ASSERT_TRUE(inside);
    EXPECT_EQ(inside->size(), length);
    EXPECT_EQ(inside->data(), image.data());
    for (std::size_t at = 0; at < image.size(); ++at) {
      std::vector<std::byte> changed = image;
      changed[at] ^= std::byte{16};
      EXPECT_FALSE(sealed_part(changed)) << "byte " << at << " of " << image.size();
    }
    image.pop_back();
    EXPECT_FALSE(sealed_part(image));
  }
  EXPECT_FALSE(sealed_part({}));
}

}  // namespace
}  // namespace pbmpi::core
