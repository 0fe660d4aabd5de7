/// Which ODE space is best for how many geoms: where ode::best_space() has its number from.
#pragma once

namespace pbmpi::bench {

/// Prints the time of a broad phase for piles of boxes of growing size, in both spaces.
void compare_spaces();

}  // namespace pbmpi::bench
