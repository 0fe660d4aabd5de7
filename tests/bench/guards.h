/// Measures what guards cost.
#pragma once

namespace pbmpi::bench {

/// Steps scenes in sor and in quick, with and without guards, alternating frame by frame; prints the median
/// of the frames' ratios of CPU time.
void compare_guards();

}  // namespace pbmpi::bench
