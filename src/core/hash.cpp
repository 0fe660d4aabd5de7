#include "core/hash.h"

#include <bit>

namespace pbmpi::core {

void Hash64::add(std::uint64_t word) {
  constexpr std::uint64_t prime = 0x100000001b3ull;
  for (int byte = 0; byte < 8; ++byte) {
    value_ = (value_ ^ (word & 0xff)) * prime;
    word >>= 8;
  }
}

void Hash64::add(const double* values, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) add(std::bit_cast<std::uint64_t>(values[i]));
}

std::string to_hex(std::uint64_t value) {
  static constexpr char digits[] = "0123456789abcdef";
  std::string text(16, '0');
  for (int i = 15; i >= 0; --i, value >>= 4) text[i] = digits[value & 0xf];
  return text;
}

}  // namespace pbmpi::core
