/// Where a joint of the model lies in the frames of its two bodies.
#pragma once

#include "bullet/objects/bodies.h"

namespace pbmpi::bullet {

/// The frames between which a btGeneric6DofSpring2Constraint measures. Along z lies axis 1, in the frame of
/// a; along x axis 2, in that of b. Bullet's angles then are the model's, of a as seen from b; its lengths
/// are those of b as seen from a, so that along z of a slider lies minus axis 1.
struct JointFrames {
  btTransform a, b;
};

/// At the initial poses, which the bodies need not have at the moment. Throws core::InputError for two axes
/// that are parallel.
JointFrames frames_of(const model::Model& model, const model::Joint& joint, const Bodies& bodies);

}  // namespace pbmpi::bullet
