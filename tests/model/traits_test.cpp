#include <gtest/gtest.h>

#include "model/joint_traits.h"
#include "model/shape_traits.h"

namespace pbmpi::model {
namespace {

TEST(JointTraits, stand_in_the_order_of_the_kinds) {
  for (int i = 0; i < num_joint_kinds; ++i) {
    const auto kind = static_cast<JointKind>(i);
    EXPECT_EQ(traits_of(kind).kind, kind);
  }
}

TEST(JointTraits, remove_as_many_degrees_of_freedom_as_odes_joints) {
  EXPECT_EQ(traits_of(JointKind::ball).held_rows(), 3);
  EXPECT_EQ(traits_of(JointKind::hinge).held_rows(), 5);
  EXPECT_EQ(traits_of(JointKind::slider).held_rows(), 5);
  EXPECT_EQ(traits_of(JointKind::universal).held_rows(), 4);
  EXPECT_EQ(traits_of(JointKind::fixed).held_rows(), 6);
  EXPECT_EQ(traits_of(JointKind::hinge2).held_rows(), 4);
}

TEST(JointTraits, have_limits_and_motors_on_their_axes_only) {
  for (const JointTraits& traits : joint_traits) {
    for (int axis = 0; axis < 2; ++axis) {
      const AxisTraits& can = traits.axes[static_cast<std::size_t>(axis)];
      EXPECT_EQ(can.has_motor, axis < traits.num_axes) << traits.name;
      EXPECT_TRUE(can.has_motor || !can.has_limit) << traits.name;
    }
  }
  EXPECT_FALSE(traits_of(JointKind::hinge2).axes[1].has_limit) << "an axle turns without end";
}

TEST(JointTraits, tell_which_joints_move_along_their_axis) {
  Joint joint;
  joint.kind = JointKind::slider;
  EXPECT_TRUE(moves_along_axis(joint));
  joint.kind = JointKind::hinge2;
  EXPECT_FALSE(moves_along_axis(joint)) << "rigid without a spring";
  joint.suspension.stiffness = 1;
  EXPECT_TRUE(moves_along_axis(joint));
  joint.kind = JointKind::hinge;
  EXPECT_FALSE(moves_along_axis(joint));
}

TEST(ShapeTraits, stand_in_the_order_of_the_shapes) {
  for (int i = 0; i < num_shapes; ++i) {
    const auto shape = static_cast<Shape>(i);
    EXPECT_EQ(traits_of(shape).shape, shape);
  }
}

TEST(ShapeTraits, use_each_of_their_sizes_once) {
  for (const ShapeTraits& traits : shape_traits) {
    int uses = traits.radius == no_size ? 0 : 1;
    for (const int size : traits.length) uses += size == no_size ? 0 : 1;
    EXPECT_EQ(uses, traits.num_sizes) << traits.name;
  }
}

}  // namespace
}  // namespace pbmpi::model
