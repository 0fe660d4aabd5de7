/// Where a straight way enters a geom. Knows no engine; double for every stepper.
#pragma once

#include <optional>

#include "model/contact.h"
#include "model/model.h"

namespace pbmpi::geometry {

/// Where a way comes into a geom from outside.
struct Entry {
  double share = 0;   ///< of the way: 0 at its start, 1 at its end
  core::Vec3 normal;  ///< unit, world frame, out of the geom
};

/// The first point of the way from `from` to `from + way` [m, world frame] that lies in the geom, which
/// stands at `pose` (the geom's own, see geom_pose()). Nothing if the way misses it or starts inside.
std::optional<Entry> enter(const model::Geom& geom, const model::BodyPose& pose, const core::Vec3& from,
                           const core::Vec3& way);

}  // namespace pbmpi::geometry
