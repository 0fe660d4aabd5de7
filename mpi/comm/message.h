/// Messages made of arrays of plain values, whose lengths travel along.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <utility>
#include <vector>

#include "core/error.h"
#include "mpi/comm/communicator.h"

namespace pbmpi::mpi {

/// Puts arrays one behind the other, each at a multiple of 8 bytes.
class MessageWriter {
 public:
  template <Sendable T>
  void put(std::span<const T> values) {
    const auto count = static_cast<std::int64_t>(values.size());
    append(&count, sizeof count);
    append(values.data(), values.size_bytes());
  }
  template <Sendable T>
  void put(const std::vector<T>& values) {
    put(std::span<const T>(values));
  }
  template <Sendable T>
  void put_value(const T& value) {
    put(std::span<const T>(&value, 1));
  }
  std::vector<std::byte> take() { return std::move(bytes_); }

 private:
  void append(const void* data, std::size_t size) {
    const std::size_t at = bytes_.size();
    bytes_.resize(at + (size + 7) / 8 * 8);
    if (size > 0) std::memcpy(bytes_.data() + at, data, size);
  }
  std::vector<std::byte> bytes_;
};

/// Reads the arrays of a MessageWriter, in the same order. Throws std::logic_error if the message does not
/// hold them (the ranks would then run different programs).
class MessageReader {
 public:
  explicit MessageReader(std::vector<std::byte> bytes) : bytes_(std::move(bytes)) {}

  /// The span is valid as long as the reader lives.
  template <Sendable T>
  std::span<const T> get() {
    static_assert(alignof(T) <= 8);
    std::int64_t count = 0;
    std::memcpy(&count, next(sizeof count), sizeof count);
    const std::size_t size = static_cast<std::size_t>(count) * sizeof(T);
    return {reinterpret_cast<const T*>(next(size)), static_cast<std::size_t>(count)};
  }
  template <Sendable T>
  T get_value() {
    const std::span<const T> values = get<T>();
    core::require_invariant(values.size() == 1, "a message holds one value where one is read");
    return values.front();
  }

 private:
  const std::byte* next(std::size_t size) {
    core::require_invariant(size <= bytes_.size() - at_, "a message holds what is read from it");
    const std::byte* data = bytes_.data() + at_;
    at_ += (size + 7) / 8 * 8;
    return data;
  }
  std::vector<std::byte> bytes_;
  std::size_t at_ = 0;
};

}  // namespace pbmpi::mpi
