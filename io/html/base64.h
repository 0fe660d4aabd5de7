/// Base64 (RFC 4648, section 4), which encodes arrays of numbers inside the page's JSON.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace pbmpi::io::html {

/// Encodes with padding, without line breaks.
std::string base64(std::span<const std::byte> bytes);

/// Encodes the bytes of the numbers in this machine's byte order, which the browser's typed arrays must
/// share: both are little-endian on every machine that Debian's MPI packages support (checked at compile
/// time).
template <class Number>
std::string base64_of(const std::vector<Number>& numbers) {
  return base64(std::as_bytes(std::span(numbers)));
}

/// Number of base64 characters for this number of bytes.
constexpr std::int64_t base64_length(std::int64_t bytes) { return (bytes + 2) / 3 * 4; }

}  // namespace pbmpi::io::html
