/// A checksum after the bytes of a file that is written whole: later changes are noticed before HDF5 reads
/// any of it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace pbmpi::core {

/// A checksum of bytes that arrive in pieces. A change within 8 neighbouring bytes, of a bit or a word,
/// always changes it.
class Checksum {
 public:
  void add(std::span<const std::byte> bytes);
  std::uint64_t value() const;

 private:
  void add_word(std::uint64_t word);

  std::uint64_t value_ = 0x9e3779b97f4a7c15ull;
  std::uint64_t word_ = 0;  ///< bytes that do not fill a word yet
  std::size_t num_bytes_ = 0;
};

/// Appends the seal: "PBMPISUM", the number of bytes before it, their checksum. HDF5 ignores data after the
/// end of a file that it knows, and drops the data when it writes to the file.
void add_seal(std::vector<std::byte>& image);
/// The bytes before the seal at the end of `image`; empty if there is no seal, or they have changed.
std::optional<std::span<const std::byte>> sealed_part(std::span<const std::byte> image);

enum class Seal { none, intact, broken };
/// Checks a file against its seal. Throws InputError like require_readable_file().
Seal seal_of(const std::string& path);

}  // namespace pbmpi::core
