#include "model/names.h"
#include "stepping/names.h"

#include <gtest/gtest.h>

namespace pbmpi::model {
namespace {

TEST(Names, lead_back_to_their_enumerators) {
  for (int i = 0; i < num_shapes; ++i) {
    const auto shape = static_cast<Shape>(i);
    EXPECT_EQ((enum_from_name<Shape>(name_of(shape), shape_names)), shape);
  }
  for (int i = 0; i < num_joint_kinds; ++i) {
    const auto kind = static_cast<JointKind>(i);
    EXPECT_EQ((enum_from_name<JointKind>(name_of(kind), joint_kind_names)), kind);
  }
  for (int i = 0; i < num_actor_kinds; ++i) {
    const auto kind = static_cast<ActorKind>(i);
    EXPECT_EQ((enum_from_name<ActorKind>(name_of(kind), actor_kind_names)), kind);
  }
}

TEST(Names, are_those_of_the_last_enumerators_too) {
  EXPECT_EQ(name_of(Shape::plane), "plane");
  EXPECT_EQ(name_of(JointKind::hinge2), "hinge2");
  EXPECT_EQ(name_of(ActorKind::prop), "prop");
}

TEST(Names, of_nothing_give_nothing) {
  EXPECT_FALSE((enum_from_name<Shape>("teapot", shape_names)));
  EXPECT_FALSE((enum_from_name<Shape>("", shape_names)));
}

}  // namespace
}  // namespace pbmpi::model
