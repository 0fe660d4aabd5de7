/// Refuses worlds whose actors stand in each other.
#pragma once

#include <optional>
#include <string>
#include <utility>

#include "model/model.h"

namespace pbmpi::scenes {

/// How deep actors may overlap at the start unless the scene allows more [m]: soles stand 0.1 mm in the
/// ground, and a blow of a few centimetres of penetration would throw bodies apart at the first step.
inline constexpr double overlap_tolerance_m = 0.02;
/// Of small things no more than this share of the least side of the smaller one.
inline constexpr double overlap_tolerance_share = 0.25;

struct Overlap {
  int actor_a = 0, actor_b = 0;  ///< indices into Model::actors, a < b
  double depth_m = 0;            ///< at least so deep
};

/// The first two actors that overlap by more than `tolerance_m` in their initial poses (none: by more than
/// the tolerances above). Round shapes count by a box inside them, so that what is found is real; an overlap
/// at a rounded edge may go unseen. Static geoms may overlap each other, and so may actors that a joint
/// connects.
std::optional<Overlap> find_overlap(const model::Model& model,
                                    std::optional<double> tolerance_m = std::nullopt);

}  // namespace pbmpi::scenes
