/// Measures what sleeping saves.
#pragma once

namespace pbmpi::bench {

/// Steps a settled Battle2 in which all bodies sleep, and one in which all but one ball sleep, against the
/// same state kept awake, in sor and in quick: prints the ratios of their frames' CPU times.
void compare_sleeping();

}  // namespace pbmpi::bench
