/// How much a rank sends.
#pragma once

#include <cstdint>

namespace pbmpi::core {

/// Messages that a rank sent to others inside the steps of a frame.
struct Traffic {
  std::int64_t messages = 0;
  std::int64_t bytes = 0;
};

}  // namespace pbmpi::core
