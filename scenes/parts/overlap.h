/// Refuses worlds whose actors overlap.
#pragma once

#include <optional>
#include <string>
#include <utility>

#include "model/model.h"

namespace pbmpi::scenes {

/// How deep actors may overlap at the start unless the scene allows more [m]: soles start 0.1 mm deep in the
/// ground, and a penetration of a few centimetres would throw bodies apart in the first step.
inline constexpr double overlap_tolerance_m = 0.02;
/// For small geoms the overlap is also limited to this share of the smaller one's least side.
inline constexpr double overlap_tolerance_share = 0.25;

struct Overlap {
  int actor_a = 0, actor_b = 0;  ///< indices into Model::actors, a < b
  double depth_m = 0;            ///< lower bound of the overlap
};

/// The first two actors that overlap by more than `tolerance_m` in their initial poses (none: by more than
/// the tolerances above). A round shape is represented by a box inside it, so each overlap found is real; an
/// overlap at a rounded edge may be missed. Static geoms may overlap each other, and so may actors that a
/// joint connects.
std::optional<Overlap> find_overlap(const model::Model& model,
                                    std::optional<double> tolerance_m = std::nullopt);

}  // namespace pbmpi::scenes
