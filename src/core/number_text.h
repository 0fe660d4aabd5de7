/// Numbers as text that reads back to the same bits.
#pragma once

#include <array>
#include <charconv>
#include <string>

namespace pbmpi::core {

/// A number with as many digits as are needed to read it back.
template <class Number>
std::string number_text(Number value) {
  std::array<char, 32> text{};
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr};
}

}  // namespace pbmpi::core
