/// What effects cost.
#pragma once

namespace pbmpi::bench {

/// Falling spheres without friction against the same with friction, in sor: prints the ratio of their frames'
/// CPU times, each with its error, and the frictionless one with friction demanded, which ends in the same
/// state.
void compare_effects();

}  // namespace pbmpi::bench
