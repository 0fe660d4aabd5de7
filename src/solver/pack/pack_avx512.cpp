/// Packs for avx512. Only the code between the pragmas is compiled for it; fused multiply-add is left out,
/// since it would change bits.
#include "solver/pack/pack_before_target.h"

#if defined(__clang__)
#pragma clang attribute push(__attribute__((target("avx512f,avx512vl,avx512dq,avx512bw"))), \
                             apply_to = function)
#else
#pragma GCC push_options
#pragma GCC target("avx512f,avx512vl,avx512dq,avx512bw")
#endif

#include "solver/pack/pack_lanes.h"

namespace pbmpi::solver {

std::unique_ptr<Pack> make_double_avx512(std::span<const PackedWorld> worlds) {
  return std::make_unique<PackLanes<LaneTraits<double, 8>>>(worlds);
}

std::unique_ptr<Pack> make_single_avx512(std::span<const PackedWorld> worlds) {
  return std::make_unique<PackLanes<LaneTraits<float, 16>>>(worlds);
}

}  // namespace pbmpi::solver

#if defined(__clang__)
#pragma clang attribute pop
#else
#pragma GCC pop_options
#endif
