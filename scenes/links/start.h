/// Puts the joints of a mechanism where they start.
#pragma once

#include <vector>

#include "scenes/links/links.h"

namespace pbmpi::scenes::links {

/// The mechanism in the pose in which it starts: links are where their joints' starts move them (forward
/// kinematics), anchors and axes are described in their links' frames there, and limits and drives count from
/// there. Joints that start at their poses keep all their bits.
Mechanism at_start(Mechanism mechanism);

/// The poses of all links in the mechanism's frame; before at_start() those that the file has.
std::vector<Pose> poses_of(const Mechanism& mechanism);

/// Describes a joint's anchor and axis in the frame that has `pose` in its present frame.
void describe_from(const Pose& pose, LinkJoint& joint);

}  // namespace pbmpi::scenes::links
