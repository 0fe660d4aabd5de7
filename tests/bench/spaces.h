/// Measures which ODE space is fastest for how many geoms: the source of ode::best_space()'s number.
#pragma once

namespace pbmpi::bench {

/// Prints the time of a broad phase for piles of boxes of growing size, in both spaces.
void compare_spaces();

}  // namespace pbmpi::bench
