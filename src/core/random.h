/// Random numbers that depend on their key alone: the same on every rank and in every order of calls.
#pragma once

#include <cstdint>

namespace pbmpi::core {

/// Mixes a 64-bit word (SplitMix64's finaliser: Steele, Lea, Flood, "Fast splittable pseudorandom number
/// generators", OOPSLA 2014).
constexpr std::uint64_t mix64(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15ull;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
  return x ^ (x >> 31);
}

/// One key from three, e.g. (run seed, world, step).
constexpr std::uint64_t mix_key(std::uint64_t a, std::uint64_t b, std::uint64_t c) {
  return mix64(mix64(mix64(a) ^ b) ^ c);
}

/// A uniform number in [0, 1) with 53 random bits.
constexpr double to_unit(std::uint64_t x) { return static_cast<double>(x >> 11) * 0x1.0p-53; }

}  // namespace pbmpi::core
