#include "io/html/base64.h"

#include <gtest/gtest.h>

#include <string_view>

namespace pbmpi::io::html {
namespace {

std::string encode(std::string_view text) {
  return base64(std::as_bytes(std::span(text.data(), text.size())));
}

TEST(Base64, gives_the_test_vectors_of_rfc_4648) {
  EXPECT_EQ(encode(""), "");
  EXPECT_EQ(encode("f"), "Zg==");
  EXPECT_EQ(encode("fo"), "Zm8=");
  EXPECT_EQ(encode("foo"), "Zm9v");
  EXPECT_EQ(encode("foob"), "Zm9vYg==");
  EXPECT_EQ(encode("fooba"), "Zm9vYmE=");
  EXPECT_EQ(encode("foobar"), "Zm9vYmFy");
}

TEST(Base64, keeps_the_bits_of_numbers) {
  // 1.0f is 0x3f800000, stored with its lowest byte first.
  EXPECT_EQ(base64_of(std::vector<float>{1.0f}), "AACAPw==");
  EXPECT_EQ(base64_of(std::vector<std::int32_t>{-1}), "/////w==");
}

TEST(Base64, has_the_length_that_is_foretold) {
  for (std::size_t length = 0; length < 10; ++length) {
    EXPECT_EQ(static_cast<std::int64_t>(encode(std::string(length, 'x')).size()),
              base64_length(static_cast<std::int64_t>(length)));
  }
}

}  // namespace
}  // namespace pbmpi::io::html
