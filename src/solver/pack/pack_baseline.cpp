/// Packs for every CPU: one lane, and registers of 128 bits (on x86-64 SSE2).
#include "solver/pack/pack_before_target.h"
#include "solver/pack/pack_lanes.h"

namespace pbmpi::solver {

std::unique_ptr<Pack> make_double_off(std::span<const PackedWorld> worlds) {
  return std::make_unique<PackLanes<LaneTraits<double, 1>>>(worlds);
}

std::unique_ptr<Pack> make_single_off(std::span<const PackedWorld> worlds) {
  return std::make_unique<PackLanes<LaneTraits<float, 1>>>(worlds);
}

std::unique_ptr<Pack> make_double_sse2(std::span<const PackedWorld> worlds) {
  return std::make_unique<PackLanes<LaneTraits<double, 2>>>(worlds);
}

std::unique_ptr<Pack> make_single_sse2(std::span<const PackedWorld> worlds) {
  return std::make_unique<PackLanes<LaneTraits<float, 4>>>(worlds);
}

}  // namespace pbmpi::solver
