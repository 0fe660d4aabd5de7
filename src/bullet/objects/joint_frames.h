/// The frames of a model joint in its two bodies.
#pragma once

#include "bullet/objects/bodies.h"

namespace pbmpi::bullet {

/// The frames between which a btGeneric6DofSpring2Constraint measures. Axis 1 lies along z in the frame of a,
/// axis 2 along x in that of b. Bullet's angles are then the model's: those of a relative to b. Its lengths
/// are those of b relative to a, so a slider has minus axis 1 along z.
struct JointFrames {
  btTransform a, b;
};

/// The frames at the initial poses, at which the bodies need not be at present. Throws core::InputError for
/// two axes that are parallel.
JointFrames frames_of(const model::Model& model, const model::Joint& joint, const Bodies& bodies);

}  // namespace pbmpi::bullet
