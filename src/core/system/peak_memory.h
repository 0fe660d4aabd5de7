/// How much memory this process has needed.
#pragma once

#include <cstdint>

namespace pbmpi::core {

/// The most bytes of memory that the process has had at once (VmHWM of Linux: what it shares with other
/// processes counts in each of them); 0 where the system does not say.
std::int64_t peak_memory_bytes();

}  // namespace pbmpi::core
