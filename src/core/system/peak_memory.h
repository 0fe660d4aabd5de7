/// The memory that this process has needed.
#pragma once

#include <cstdint>

namespace pbmpi::core {

/// The most bytes of memory that the process has had at once (Linux's VmHWM: memory shared with other
/// processes counts in each of them); 0 where the system does not say.
std::int64_t peak_memory_bytes();

}  // namespace pbmpi::core
