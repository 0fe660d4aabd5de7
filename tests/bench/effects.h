/// Measures what effects cost.
#pragma once

namespace pbmpi::bench {

/// Steps falling spheres without friction against the same spheres with friction, in sor. Prints the ratio of
/// their frames' CPU times, each with its error, and the frictionless spheres with friction demanded, which
/// end in the same state.
void compare_effects();

}  // namespace pbmpi::bench
