/// A checksum behind the bytes of a file that is written whole: what has changed since then is noticed before
/// HDF5 looks at any of it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace pbmpi::core {

/// A checksum of bytes that come piece by piece. A change of 8 neighbouring bytes at most, a bit or a word,
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

/// Appends the seal: "PBMPISUM", the number of bytes before it, their checksum. HDF5 passes over what stands
/// behind the end of a file that it knows, and drops it when it writes into the file.
void add_seal(std::vector<std::byte>& image);
/// The bytes before the seal at the end of `image`; none where there is no seal, or they have changed.
std::optional<std::span<const std::byte>> sealed_part(std::span<const std::byte> image);

enum class Seal { none, intact, broken };
/// What the end of the file says of the rest of it. Throws InputError as require_readable_file()
/// does.
Seal seal_of(const std::string& path);

}  // namespace pbmpi::core
