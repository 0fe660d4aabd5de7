/// Where a straight path enters a geom. Independent of the engine; double for every stepper.
#pragma once

#include <optional>

#include "model/contact.h"
#include "model/model.h"

namespace pbmpi::geometry {

/// Where a path enters a geom from outside.
struct Entry {
  double share = 0;   ///< share of the path: 0 at its start, 1 at its end
  core::Vec3 normal;  ///< unit, world frame, pointing out of the geom
};

/// The first point of the path from `from` to `from + way` [m, world frame] that lies in the geom at `pose`
/// (the geom's own, see geom_pose()). Nothing if the path misses the geom or starts inside it.
std::optional<Entry> enter(const model::Geom& geom, const model::BodyPose& pose, const core::Vec3& from,
                           const core::Vec3& way);

}  // namespace pbmpi::geometry
