/// Numbers and points that are the same in every run.
#pragma once

#include <cstdint>

#include "core/random.h"
#include "core/vector.h"

namespace pbmpi::geometry {

/// From 0 to 1.
inline double number(int i, std::uint64_t k) {
  return core::to_unit(core::mix_key(7, static_cast<std::uint64_t>(i), k));
}

/// In a cube of this side.
inline core::Vec3 point(int i, std::uint64_t k, double side) {
  return {side * number(i, k), side * number(i, k + 1), side * number(i, k + 2)};
}

}  // namespace pbmpi::geometry
