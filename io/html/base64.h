/// Base64 (RFC 4648, section 4): how arrays of numbers travel inside the page's JSON.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace pbmpi::io::html {

/// With padding, without line breaks.
std::string base64(std::span<const std::byte> bytes);

/// The bytes of the numbers in this machine's order, which the browser's typed arrays must share: both are
/// little-endian on every machine that Debian's MPI packages serve (checked at compile time).
template <class Number>
std::string base64_of(const std::vector<Number>& numbers) {
  return base64(std::as_bytes(std::span(numbers)));
}

/// Characters that base64 makes of so many bytes.
constexpr std::int64_t base64_length(std::int64_t bytes) { return (bytes + 2) / 3 * 4; }

}  // namespace pbmpi::io::html
