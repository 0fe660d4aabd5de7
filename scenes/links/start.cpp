#include "scenes/links/start.h"

namespace pbmpi::scenes::links {
namespace {

/// The motion of a joint from its link's pose to its start, in the link's frame.
Pose motion_of(const LinkJoint& joint) {
  if (joint.motion == Motion::slide) return {joint.start * joint.axis, {}};
  const Quat turn = joint.motion == Motion::ball ? joint.start_turn : rotation(joint.start, joint.axis);
  return {joint.anchor - turn.to_eigen() * joint.anchor, turn};
}

bool starts_at_pose(const LinkJoint& joint) {
  if (joint.motion == Motion::free) return true;
  return joint.motion == Motion::ball ? joint.start_turn == Quat{} : joint.start == 0;
}

/// Joints move from the parent on: those beyond have not moved the link's frame yet, and those before turn
/// back in it.
void start(Link& link) {
  for (std::size_t i = 0; i < link.joints.size(); ++i) {
    LinkJoint& joint = link.joints[i];
    if (starts_at_pose(joint)) continue;
    const Pose motion = motion_of(joint);
    link.pose = compose(link.pose, motion);
    for (std::size_t before = 0; before < i; ++before) describe_from(motion, link.joints[before]);
    joint.limit.low -= joint.start;
    joint.limit.high -= joint.start;
    joint.drive.target -= joint.start;
  }
}

}  // namespace

void describe_from(const Pose& pose, LinkJoint& joint) {
  const Eigen::Quaterniond back = pose.orientation.to_eigen().conjugate();
  joint.anchor = back * (joint.anchor - pose.position);
  joint.axis = (back * joint.axis).normalized();
}

std::vector<Pose> poses_of(const Mechanism& mechanism) {
  std::vector<Pose> poses;
  poses.reserve(mechanism.links.size());
  for (const Link& link : mechanism.links)
    poses.push_back(link.parent == no_link
                        ? link.pose
                        : compose(poses[static_cast<std::size_t>(link.parent)], link.pose));
  return poses;
}

Mechanism at_start(Mechanism mechanism) {
  for (Link& link : mechanism.links) start(link);
  return mechanism;
}

}  // namespace pbmpi::scenes::links
