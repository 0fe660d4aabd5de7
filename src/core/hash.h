/// The hash by which two runs are compared bit for bit.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace pbmpi::core {

/// FNV-1a over bytes, 64 bit (Fowler, Noll, Vo), fed 8 bytes at a time.
class Hash64 {
 public:
  /// Adds `count` doubles by their bits: -0.0 and 0.0 differ, and so do NaNs with different payloads.
  void add(const double* values, std::size_t count);
  void add(std::uint64_t word);
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325ull;
};

/// 16 lower-case hex digits.
std::string to_hex(std::uint64_t value);

}  // namespace pbmpi::core
