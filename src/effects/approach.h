/// Do two geoms come nearer to each other, and may they begin to touch?
#pragma once

#include "model/contact.h"
#include "model/model.h"

namespace pbmpi::effects {

/// [m] By how much a geom at this pose that moves by `way` [m, world frame] comes nearer to a static one:
/// the part of `way` towards the nearest point of what is static, so that what slides along a floor does not
/// approach it. All of `way` if the geom's centre is within the other. Of a mesh the triangles near the path
/// count, with their normals.
double approach_to_static(const model::Geom& geom, const model::BodyPose& pose, const core::Vec3& way,
                          const model::Geom& other, const model::BodyPose& other_pose);

/// May a geom that moves by `way` relative to another one touch it on its way, if that moves by at most
/// `room` [m] besides? Compares world-aligned boxes, and with a plane the height above it.
bool may_meet(const model::Geom& geom, const model::BodyPose& pose, const core::Vec3& way,
              const model::Geom& other, const model::BodyPose& other_pose, double room);

}  // namespace pbmpi::effects
