#include "model/joint_gap.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/models.h"
#include "support/random_state.h"

namespace pbmpi::model {
namespace {

/// Tolerance for numbers of size 10 to 1000 after some dozen roundings.
constexpr double rounding = 1e-12;

Model two_boxes() {
  Model model;
  const int actor = support::add_actor(model, "boxes");
  support::add_solid(model, actor, "a", Shape::box, {1, 1, 1}, 2, {0, 0, 3});
  support::add_solid(model, actor, "b", Shape::box, {1, 1, 1}, 6, {2, 0, 0.5});
  return model;
}

TEST(JointGap, is_zero_at_the_start_for_every_kind) {
  for (int kind = 0; kind < num_joint_kinds; ++kind) {
    Model model = two_boxes();
    support::add_joint(model, static_cast<JointKind>(kind), 0, 1, {1, 0, 2});
    EXPECT_NEAR(max_joint_gap(model, initial_state(model)), 0, rounding) << "kind " << kind;
  }
}

TEST(JointGap, is_the_distance_of_the_anchors) {
  for (const JointKind kind :
       {JointKind::ball, JointKind::hinge, JointKind::universal, JointKind::hinge2, JointKind::fixed}) {
    Model model = two_boxes();
    support::add_joint(model, kind, 0, 1, {1, 0, 2});
    State state = initial_state(model);
    state.position[1] += Vec3(0.3, 0, 0.4);
    EXPECT_NEAR(joint_gap(model, state, model.joints[0]), 0.5, rounding);
  }
}

TEST(JointGap, leaves_out_what_may_slide) {
  Model model = two_boxes();
  support::add_joint(model, JointKind::slider, 0, 1, {1, 0, 2}, Vec3::UnitZ());
  support::add_joint(model, JointKind::hinge2, 0, 1, {1, 0, 2}, Vec3::UnitZ(), Vec3::UnitY());
  model.joints[1].suspension.stiffness = 1000;
  State state = initial_state(model);
  state.position[1] += Vec3(0.3, 0, 0.4);
  EXPECT_NEAR(joint_gap(model, state, model.joints[0]), 0.3, rounding);
  EXPECT_NEAR(joint_gap(model, state, model.joints[1]), 0.3, rounding);
}

TEST(JointGap, turns_with_the_first_body) {
  Model model = two_boxes();
  support::add_joint(model, JointKind::ball, 0, 1, {1, 0, 3});
  State state = initial_state(model);
  state.orientation[0] =
      support::rotation(Vec3::UnitZ(), std::acos(-1.0));  // turns the anchor from x = 1 to -1
  EXPECT_NEAR(joint_gap(model, state, model.joints[0]), 2, rounding);
}

TEST(JointGap, to_the_world_counts_from_the_world_anchor) {
  Model model = support::pendulum(1, 0.3);
  State state = initial_state(model);
  EXPECT_NEAR(max_joint_gap(model, state), 0, rounding);
  state.position[0].y() += 0.01;
  EXPECT_NEAR(max_joint_gap(model, state), 0.01, rounding);
}

TEST(MaxJointGap, is_zero_without_joints) {
  const Model model = two_boxes();
  EXPECT_EQ(max_joint_gap(model, initial_state(model)), 0);
}

TEST(JointGap, is_the_same_vector_in_the_frame_of_the_first_body) {
  const Model model = support::crash();
  State state = initial_state(model);
  for (int i = 0; i < state.num_bodies(); ++i) {
    state.position[i] += 0.01 * i * Vec3(0.3, -0.2, 0.1 * (i % 3));
    state.orientation[i] = Quat::from_eigen(support::rotation(Vec3(1, 2, -2) / 3, 0.02 * i).to_eigen() *
                                            state.orientation[i].to_eigen());
  }
  const auto pose_of = [&](int body) {
    return body == no_body ? Pose{} : Pose{state.position[body], state.orientation[body]};
  };
  for (const Joint& joint : model.joints) {
    const Pose a = pose_of(joint.body_a), b = pose_of(joint.body_b);
    const Vec3 in_a = joint_gap_vector_in_a(model, joint, a, b);
    EXPECT_NEAR((joint_gap_vector(model, joint, a, b) - a.direction_to_outer(in_a)).norm(), 0, rounding)
        << joint.name;
  }
}

TEST(JointGaps, largest_is_that_of_the_joints_that_hold_to_the_bit) {
  Model model = support::crash();
  support::add_joint(model, JointKind::slider, 0, no_body, {0, 0, 1});
  const JointGaps gaps(model);
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    State state = support::random_state(model, seed);
    state.broken_in.assign(model.joints.size(), unbroken);
    for (std::size_t joint = seed; joint < model.joints.size(); joint += 3) state.broken_in[joint] = 0;
    double largest = 0;
    for (std::size_t joint = 0; joint < model.joints.size(); ++joint) {
      if (!state.is_broken(joint)) largest = std::max(largest, joint_gap(model, state, model.joints[joint]));
    }
    ASSERT_EQ(gaps.largest(state), largest) << "seed " << seed;
  }
}

}  // namespace
}  // namespace pbmpi::model
