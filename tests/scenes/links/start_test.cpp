#include "scenes/links/start.h"

#include <gtest/gtest.h>

#include "core/random.h"

namespace pbmpi::scenes::links {
namespace {

constexpr double rounding = 1e-12;  // for lengths of order 1, after six motions

double uniform(int number) {
  return 2 * core::to_unit(core::mix_key(7, 0, static_cast<std::uint64_t>(number))) - 1;
}

Vec3 vector(int number) { return {uniform(3 * number), uniform(3 * number + 1), uniform(3 * number + 2)}; }

Quat turn(int number) { return rotation(2 * uniform(number), vector(number).normalized()); }

/// A joint of the `number`-th kind, anchor and axis.
LinkJoint joint(int number, Motion motion) {
  LinkJoint joint;
  joint.motion = motion;
  joint.anchor = vector(10 + number);
  joint.axis = vector(20 + number).normalized();
  joint.limit = {-2, 1};
  joint.drive.target = 0.25;
  return joint;
}

Eigen::Isometry3d transform(const Pose& pose) {
  return Eigen::Translation3d(pose.position) * pose.orientation.to_eigen();
}

/// The joint's motion by itself, in the frame in which it is described.
Eigen::Isometry3d motion(const LinkJoint& joint, double value, const Quat& ball) {
  if (joint.motion == Motion::slide) return Eigen::Isometry3d(Eigen::Translation3d(value * joint.axis));
  const Eigen::Quaterniond turn = joint.motion == Motion::ball
                                      ? ball.to_eigen()
                                      : Eigen::Quaterniond(Eigen::AngleAxisd(value, joint.axis));
  return Eigen::Translation3d(joint.anchor) * turn * Eigen::Translation3d(-joint.anchor);
}

/// Links of one, two and three joints of all kinds, each link in the one before.
Mechanism mechanism() {
  constexpr Motion hinge = Motion::hinge, slide = Motion::slide, ball = Motion::ball;
  const std::vector<std::vector<Motion>> kinds = {
      {hinge}, {slide, hinge}, {hinge, ball, slide}, {}, {hinge, hinge, hinge}};
  Mechanism result;
  int number = 0;
  for (const auto& joints : kinds) {
    Link link;
    link.parent = static_cast<int>(result.links.size()) - 1;
    link.pose = {vector(40 + number), turn(50 + number)};
    for (const Motion motion : joints) link.joints.push_back(joint(number++, motion));
    result.links.push_back(link);
  }
  return result;
}

void expect_equal(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
  EXPECT_LT((a.matrix() - b.matrix()).norm(), rounding);
}

// Forward kinematics by 4 x 4 matrices, joint after joint, as MuJoCo's reference and ROS' specification have
// it.
TEST(Start, places_links_by_forward_kinematics) {
  Mechanism given = mechanism();
  std::vector<Eigen::Isometry3d> expected;
  int number = 0;
  for (Link& link : given.links) {
    Eigen::Isometry3d pose = transform(link.pose);
    for (LinkJoint& joint : link.joints) {
      joint.start = 1.5 * uniform(70 + number);
      joint.start_turn = turn(80 + number++);
      pose = pose * motion(joint, joint.start, joint.start_turn);
    }
    expected.push_back(pose);
  }
  const Mechanism started = at_start(given);
  for (std::size_t i = 0; i < expected.size(); ++i)
    expect_equal(transform(started.links[i].pose), expected[i]);
}

// A joint that moves on from its start takes the link where the sum of the two motions would have taken it.
TEST(Start, describes_joints_where_they_are_then) {
  Mechanism given = mechanism();
  std::vector<LinkJoint>& joints = given.links[2].joints;
  joints[0].start = 0.7;
  joints[1].start_turn = turn(3);
  joints[2].start = -0.4;
  const Link started = at_start(given).links[2];
  Mechanism further = given;
  further.links[2].joints[0].start += 0.9;
  expect_equal(transform(started.pose) * motion(started.joints[0], 0.9, {}),
               transform(at_start(further).links[2].pose));
  further = given;
  further.links[2].joints[2].start += 0.3;
  expect_equal(transform(started.pose) * motion(started.joints[2], 0.3, {}),
               transform(at_start(further).links[2].pose));
}

TEST(Start, counts_limits_and_drives_from_there) {
  Mechanism given = mechanism();
  given.links[1].joints[1].start = 0.75;
  const LinkJoint& started = at_start(given).links[1].joints[1];
  EXPECT_EQ(started.limit.low, -2.75);
  EXPECT_EQ(started.limit.high, 0.25);
  EXPECT_EQ(started.drive.target, -0.5);
}

TEST(Start, keeps_the_bits_of_what_starts_at_its_pose) {
  const Mechanism given = mechanism(), started = at_start(given);
  for (std::size_t i = 0; i < given.links.size(); ++i) {
    EXPECT_EQ(started.links[i].pose.position, given.links[i].pose.position);
    EXPECT_EQ(started.links[i].pose.orientation, given.links[i].pose.orientation);
    for (std::size_t k = 0; k < given.links[i].joints.size(); ++k)
      EXPECT_EQ(started.links[i].joints[k].axis, given.links[i].joints[k].axis);
  }
}

}  // namespace
}  // namespace pbmpi::scenes::links
