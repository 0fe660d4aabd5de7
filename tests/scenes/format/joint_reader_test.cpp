#include "scenes/format/joint_reader.h"

#include <gtest/gtest.h>

#include <numbers>

#include "../helpers.h"
#include "stepping/observables.h"

namespace pbmpi::scenes {
namespace {

// Two turned boxes, so that body frames and world frame differ. The joint begins at line 14.
const std::string two_boxes = R"(title = "t"
[[actor]]
name = "a"
type = "box"
size = [1, 1, 1]
mass = 1
heading = 30
[[actor]]
name = "b"
type = "box"
size = [1, 1, 1]
mass = 1
position = [2, 0, 0]
)";

std::string with_joint(const std::string& keys) { return two_boxes + "[[joint]]\nname = \"j\"\n" + keys; }

TEST(JointReader, turns_world_anchors_and_axes_into_those_of_the_bodies) {
  const auto model =
      build(with_joint("kind = \"universal\"\nbodies = [\"a\", \"b\"]\nanchor = [1, 0, 0.5]\naxis = [0, 0, "
                       "2]\naxis2 = [0, 3, 0]\n"));
  const model::Joint& j = joint(*model, "j");
  const Pose a = body(*model, "a").pose;
  const Pose b = body(*model, "b").pose;
  // 1e-15: rounding of a rotation and its inverse of vectors of length 1.
  EXPECT_LT((a.point_to_outer(j.anchor_a) - Vec3(1, 0, 0.5)).norm(), 1e-15);
  EXPECT_LT((b.point_to_outer(j.anchor_b) - Vec3(1, 0, 0.5)).norm(), 1e-15);
  EXPECT_LT((a.direction_to_outer(j.axis1_a) - Vec3(0, 0, 1)).norm(), 1e-15);
  EXPECT_LT((b.direction_to_outer(j.axis2_b) - Vec3(0, 1, 0)).norm(), 1e-15);
}

TEST(JointReader, reads_limits_in_degrees_and_motors) {
  const auto model =
      build(with_joint("kind = \"hinge\"\nbodies = [\"a\", \"world\"]\nanchor = [0, 0, 0]\naxis = [0, 0, "
                       "1]\nlimits = [-90, 765]\narmature = 0.25\n"
                       "motor = { velocity = 2, max_force = 30, hold_rate = 8 }\n"));
  const model::Joint& j = joint(*model, "j");
  EXPECT_EQ(j.body_b, model::no_body);
  EXPECT_DOUBLE_EQ(j.limits[0].low, -std::numbers::pi / 2);
  EXPECT_DOUBLE_EQ(j.limits[0].high, 4.25 * std::numbers::pi) << "more than two turns";
  EXPECT_EQ(j.armature, (std::array<double, 2>{0.25, 0}));
  EXPECT_EQ(j.motors[0].velocity, 2);
  EXPECT_EQ(j.motors[0].max_force, 30);
  EXPECT_EQ(j.motors[0].hold_rate, 8);
}

TEST(JointReader, reads_the_strength_of_every_kind) {
  const auto ball =
      build(with_joint("kind = \"ball\"\nbodies = [\"a\", \"b\"]\nanchor = [1, 0, 0]\nbreak_force = 500\n"));
  EXPECT_EQ(joint(*ball, "j").break_force, 500);
  EXPECT_EQ(joint(*ball, "j").break_torque, 0);
  const auto weld = build(
      with_joint("kind = \"fixed\"\nbodies = [\"a\", \"b\"]\nbreak_torque = 70\nanchor = [1, 0, 0.5]\n"));
  EXPECT_EQ(joint(*weld, "j").break_torque, 70);
  const Vec3 anchor = body(*weld, "a").pose.point_to_outer(joint(*weld, "j").anchor_a);
  EXPECT_LT((anchor - Vec3(1, 0, 0.5)).norm(), 1e-15);  // rounding of a rotation and its inverse
}

TEST(JointReader, refuses_a_negative_strength_and_a_weld_without_the_place_of_its_torque) {
  const std::string fixed = "kind = \"fixed\"\nbodies = [\"a\", \"b\"]\n";
  EXPECT_NE(error_of(with_joint(fixed + "break_force = -1\n")).find("test.toml:18:"), std::string::npos);
  EXPECT_NE(error_of(with_joint(fixed + "break_torque = -1\n")).find("break_torque"), std::string::npos);
  EXPECT_NE(error_of(with_joint(fixed + "break_torque = 1\n")).find("anchor"), std::string::npos);
}

TEST(JointReader, reads_a_sliders_limits_in_metres) {
  const auto model =
      build(with_joint("kind = \"slider\"\nbodies = [\"a\", \"b\"]\naxis = [1, 0, 0]\nlimits = [-0.5, 2]\n"));
  EXPECT_EQ(joint(*model, "j").limits[0].low, -0.5);
  EXPECT_EQ(joint(*model, "j").limits[0].high, 2);
}

TEST(JointReader, joins_bodies_of_actors_by_their_full_name) {
  const auto model =
      build(scene_with("human") +
            "[[joint]]\nname = \"rope\"\nkind = \"ball\"\nbodies = [\"a.left_hand\", \"world\"]\n"
            "anchor = [0, 0, 2]\n");
  EXPECT_EQ(model->bodies[joint(*model, "rope").body_a].name, "a.left_hand");
}

struct Mistake {
  const char* name;
  std::string keys;
  std::string place;
  std::string says;
};

void PrintTo(const Mistake& mistake, std::ostream* out) { *out << mistake.name; }

class JointMistake : public testing::TestWithParam<Mistake> {};

TEST_P(JointMistake, is_told_with_file_line_and_column) {
  const std::string message = error_of(with_joint(GetParam().keys));
  EXPECT_EQ(message.find("test.toml:" + GetParam().place + ": joint 'j'"), 0u) << message;
  EXPECT_NE(message.find(GetParam().says), std::string::npos) << message;
}

const std::string ball = "kind = \"ball\"\n";
const std::string hinge = "kind = \"hinge\"\nbodies = [\"a\", \"b\"]\nanchor = [0, 0, 0]\n";

INSTANTIATE_TEST_SUITE_P(
    Joints, JointMistake,
    testing::Values(
        Mistake{"to_itself", ball + "bodies = [\"a\", \"a\"]\nanchor = [0, 0, 0]\n", "17:10",
                "'a' to itself"},
        Mistake{"unknown_body", ball + "bodies = [\"a\", \"c\"]\nanchor = [0, 0, 0]\n", "17:10",
                "unknown body 'c'"},
        Mistake{"slip_of_world", ball + "bodies = [\"a\", \"wrld\"]\nanchor = [0, 0, 0]\n", "17:10",
                "unknown body 'wrld'; did you mean 'world'"},
        Mistake{"slip_of_a_key", "knd = \"ball\"\n", "16:7", "'kind' is missing; is 'knd' meant for it?"},
        Mistake{"three_bodies", ball + "bodies = [\"a\", \"b\", \"c\"]\n", "17:10", "must name two bodies"},
        Mistake{"world_first", ball + "bodies = [\"world\", \"a\"]\n", "17:10", "must be the second"},
        Mistake{"unknown_kind", "kind = \"hinges\"\n", "16:8", "unknown kind 'hinges'; did you mean 'hinge'"},
        Mistake{"no_anchor", ball + "bodies = [\"a\", \"b\"]\n", "14:1", "'anchor' is missing"},
        Mistake{"limits_of_a_ball", ball + "bodies = [\"a\", \"b\"]\nanchor = [0, 0, 0]\nlimits = [0, 1]\n",
                "19:1", "unknown key 'limits'"},
        Mistake{"swapped_limits", hinge + "axis = [0, 0, 1]\nlimits = [10, -10]\n", "20:10", "swap them"},
        Mistake{"negative_armature", hinge + "axis = [0, 0, 1]\narmature = -1\n", "20:12", "at least 0"},
        Mistake{"zero_axis", hinge + "axis = [0, 0, 0]\n", "19:8", "no direction"},
        Mistake{"weak_motor", hinge + "axis = [0, 0, 1]\nmotor = { velocity = 1, max_force = -1 }\n", "20:37",
                "at least 0"}),
    [](const auto& test) { return test.param.name; });

TEST(JointReader, refuses_a_universal_joint_whose_axes_are_not_at_right_angles) {
  const std::string message =
      error_of(with_joint("kind = \"universal\"\nbodies = [\"a\", \"b\"]\nanchor = [0, 0, 0]\naxis = [0, 0, "
                          "1]\naxis2 = [0, 1, 1]\n"));
  EXPECT_EQ(message.find("test.toml:20:9: "), 0u) << message;
}

TEST(JointReader, refuses_a_second_joint_of_one_name) {
  const std::string one = "[[joint]]\nname = \"j\"\nkind = \"fixed\"\nbodies = [\"a\", \"b\"]\n";
  EXPECT_EQ(error_of(two_boxes + one + one).find("test.toml:19:8: joint 'j': a second joint of this name"),
            0u);
}

/// `num_links` balls in a row, a metre apart.
std::string row_of_balls(int num_links) {
  return "title = \"t\"\n[[actor]]\nname = \"link\"\ntype = \"sphere\"\nradius = 0.5\nmass = 1\ncopies = " +
         std::to_string(num_links) + "\nspacing = [1, 0, 0]\n";
}
const std::string chain_joint =
    "[[joint]]\nname = \"j\"\nkind = \"ball\"\nbodies = [\"link.1\", \"link.2\"]\nanchor = [0.5, 0, 0]\n"
    "spacing = [1, 0, 0]\n";

TEST(JointReader, copies_count_bodies_and_anchors_up) {
  const auto model = build(row_of_balls(4) + chain_joint + "copies = 3\n");
  ASSERT_EQ(model->num_joints(), 3);
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(model->joints[i].name, "j." + std::to_string(i + 1));
    EXPECT_EQ(model->joints[i].body_a, i);
    EXPECT_EQ(model->joints[i].body_b, i + 1);
    EXPECT_EQ(model->joints[i].anchor_a, Vec3(0.5, 0, 0));
    EXPECT_EQ(model->joints[i].anchor_b, Vec3(-0.5, 0, 0));
  }
}

TEST(JointReader, copies_keep_the_world_and_names_without_a_number) {
  const auto model = build(row_of_balls(3) +
                           "[[joint]]\nname = \"hook\"\nkind = \"ball\"\nbodies = [\"link.1\", \"world\"]\n"
                           "anchor = [0, 0, 1]\ncopies = 3\nspacing = [1, 0, 0]\n");
  EXPECT_EQ(model->joints[2].body_a, 2);
  EXPECT_EQ(model->joints[2].body_b, model::no_body);
  EXPECT_EQ(model->joints[2].anchor_a, Vec3(0, 0, 1));
}

TEST(JointReader, refuses_copies_beyond_the_last_body) {
  const std::string message = error_of(row_of_balls(4) + chain_joint + "copies = 4\n");
  EXPECT_EQ(message.find("test.toml:12:10: joint 'j.4': unknown body 'link.5'"), 0u) << message;
}

TEST(JointReader, closes_a_loop) {
  const auto model = build(row_of_balls(3) + chain_joint +
                           "copies = 2\n[[joint]]\nname = \"last\"\n"
                           "kind = \"ball\"\nbodies = [\"link.3\", \"link.1\"]\n"
                           "anchor = [1, 1, 0]\n");
  EXPECT_EQ(model->num_joints(), 3);
}

}  // namespace
}  // namespace pbmpi::scenes
