/// What guards cost.
#pragma once

namespace pbmpi::bench {

/// Scenes in sor and in quick, with and without guards, in turn frame by frame: prints the median of the
/// frames' ratios of CPU time.
void compare_guards();

}  // namespace pbmpi::bench
