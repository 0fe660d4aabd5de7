#include "core/system/seal.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>
#include <utility>

#include "core/system/input_file.h"

namespace pbmpi::core {
namespace {

constexpr std::array<char, 8> magic = {'P', 'B', 'M', 'P', 'I', 'S', 'U', 'M'};

struct Trailer {
  std::array<char, 8> name = magic;
  std::uint64_t num_bytes = 0;
  std::uint64_t checksum = 0;
};

}  // namespace

void Checksum::add_word(std::uint64_t word) {
  // Both operations are invertible: different values stay different.
  value_ = (value_ ^ word) * 0x100000001b3ull;
  value_ ^= value_ >> 32;
}

void Checksum::add(std::span<const std::byte> bytes) {
  constexpr std::size_t width = sizeof word_;
  std::size_t i = 0;
  for (; i < bytes.size() && num_bytes_ % width != 0; ++i, ++num_bytes_) {
    word_ |= std::to_integer<std::uint64_t>(bytes[i]) << (8 * (num_bytes_ % width));
    if (num_bytes_ % width == width - 1) add_word(std::exchange(word_, 0));
  }
  for (; i + width <= bytes.size(); i += width, num_bytes_ += width) {
    std::uint64_t word = 0;
    std::memcpy(&word, &bytes[i], width);
    add_word(word);
  }
  for (; i < bytes.size(); ++i, ++num_bytes_)
    word_ |= std::to_integer<std::uint64_t>(bytes[i]) << (8 * (num_bytes_ % width));
}

std::uint64_t Checksum::value() const {
  Checksum end = *this;
  end.add_word(word_);
  end.add_word(num_bytes_);
  return end.value_;
}

void add_seal(std::vector<std::byte>& image) {
  Checksum checksum;
  checksum.add(image);
  const Trailer trailer{magic, image.size(), checksum.value()};
  const auto bytes = std::as_bytes(std::span(&trailer, 1));
  image.insert(image.end(), bytes.begin(), bytes.end());
}

std::optional<std::span<const std::byte>> sealed_part(std::span<const std::byte> image) {
  if (image.size() < sizeof(Trailer)) return std::nullopt;
  const std::span<const std::byte> before = image.first(image.size() - sizeof(Trailer));
  Trailer trailer;
  std::memcpy(&trailer, before.data() + before.size(), sizeof trailer);
  Checksum checksum;
  checksum.add(before);
  const bool intact =
      trailer.name == magic && trailer.num_bytes == before.size() && trailer.checksum == checksum.value();
  return intact ? std::optional(before) : std::nullopt;
}

Seal seal_of(const std::string& path) {
  require_readable_file(path, "give the name of a file that pbmpi has written");
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  const std::streamoff size = file.tellg(), end = size - static_cast<std::streamoff>(sizeof(Trailer));
  Trailer trailer;
  if (end < 0 || !file.seekg(end) || !file.read(reinterpret_cast<char*>(&trailer), sizeof trailer))
    return Seal::none;
  if (trailer.name != magic) return Seal::none;
  if (trailer.num_bytes != static_cast<std::uint64_t>(end)) return Seal::broken;
  file.seekg(0);
  Checksum checksum;
  std::vector<char> piece(std::size_t{1} << 20);
  for (std::streamoff left = end; left > 0;) {
    const auto length = std::min<std::streamoff>(left, std::ssize(piece));
    if (!file.read(piece.data(), length)) return Seal::broken;
    checksum.add(std::as_bytes(std::span(piece).first(static_cast<std::size_t>(length))));
    left -= length;
  }
  return checksum.value() == trailer.checksum ? Seal::intact : Seal::broken;
}

}  // namespace pbmpi::core
