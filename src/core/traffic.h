/// Counts what a rank sends.
#pragma once

#include <cstdint>

namespace pbmpi::core {

/// Messages that a rank sent to others in a frame: inside the steps of a world that is cut, or to gather
/// whole worlds.
struct Traffic {
  std::int64_t messages = 0;
  std::int64_t bytes = 0;
};

}  // namespace pbmpi::core
