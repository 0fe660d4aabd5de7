/// Packs for avx2. Only the code between the pragmas is compiled for it; fused multiply-add is left out,
/// since it would change bits.
#include "solver/pack/pack_before_target.h"

#if defined(__clang__)
#pragma clang attribute push(__attribute__((target("avx2"))), apply_to = function)
#else
#pragma GCC push_options
#pragma GCC target("avx2")
#endif

#include "solver/pack/pack_lanes.h"

namespace pbmpi::solver {

std::unique_ptr<Pack> make_double_avx2(std::span<const PackedWorld> worlds) {
  return std::make_unique<PackLanes<LaneTraits<double, 4>>>(worlds);
}

std::unique_ptr<Pack> make_single_avx2(std::span<const PackedWorld> worlds) {
  return std::make_unique<PackLanes<LaneTraits<float, 8>>>(worlds);
}

}  // namespace pbmpi::solver

#if defined(__clang__)
#pragma clang attribute pop
#else
#pragma GCC pop_options
#endif
