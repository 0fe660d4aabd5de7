#include "scenes/urdf/urdf.h"

#include <gtest/gtest.h>

#include <numbers>

#include "../helpers.h"
#include "../mjcf/models.h"
#include "model/touch_rule.h"

namespace pbmpi::scenes {
namespace {

using model::JointKind;

constexpr double rounding = 1e-12;

std::string robot(const std::string& inside) { return "<robot name='r'>\n" + inside + "</robot>"; }

std::string link_with_mass(const std::string& name, const std::string& more = "") {
  return "<link name='" + name +
         "'><inertial><origin xyz='0 0 .5'/><mass value='2'/>"
         "<inertia ixx='1' iyy='1.5' izz='2' ixy='.1'/></inertial>" +
         more + "</link>";
}

std::string joined(const std::string& type, const std::string& more) {
  return robot("<link name='base'/>" + link_with_mass("arm") + "\n<joint name='j' type='" + type +
               "'><parent link='base'/><child link='arm'/>" + more + "</joint>");
}

TEST(Urdf, reads_masses_about_the_origin_of_the_inertial) {
  const auto model = model_of(robot(link_with_mass("arm")));
  const model::Body& arm = link(*model, "arm");
  EXPECT_EQ(arm.mass_kg, 2);
  EXPECT_EQ(arm.pose.position, Vec3(0, 0, 0.5));
  EXPECT_EQ(arm.inertia(0, 1), 0.1);
  EXPECT_EQ(arm.inertia(2, 2), 2);
}

TEST(Urdf, turns_about_fixed_axes_x_first) {
  const auto model =
      model_of(joined("revolute", "<origin rpy='0.1 0.2 0.3' xyz='1 2 3'/><limit lower='-1' upper='1'/>"));
  const Eigen::Quaterniond turn = Eigen::AngleAxisd(0.3, Vec3::UnitZ()) *
                                  Eigen::AngleAxisd(0.2, Vec3::UnitY()) *
                                  Eigen::AngleAxisd(0.1, Vec3::UnitX());
  const Vec3 centre = Vec3(1, 2, 3) + turn * Vec3(0, 0, 0.5);
  EXPECT_LT((link(*model, "arm").pose.position - centre).norm(), rounding);
}

TEST(Urdf, makes_joints_of_every_type) {
  const auto hinge = model_of(joined(
      "revolute",
      "<axis xyz='0 0 2'/><limit lower='-1' upper='2' effort='1' velocity='1'/><dynamics friction='3'/>"));
  EXPECT_EQ(joint_of(*hinge, "j").kind, JointKind::hinge);
  EXPECT_EQ(joint_of(*hinge, "j").axis1_a, Vec3::UnitZ());
  EXPECT_EQ(joint_of(*hinge, "j").limits[0].high, 2);
  EXPECT_EQ(joint_of(*hinge, "j").motors[0].max_force, 3);
  const auto wheel = model_of(joined("continuous", ""));
  EXPECT_EQ(joint_of(*wheel, "j").axis1_a, Vec3::UnitX());
  EXPECT_FALSE(joint_of(*wheel, "j").limits[0].active());
  EXPECT_EQ(joint_of(*model_of(joined("prismatic", "<limit lower='-4' upper='5'/>")), "j").limits[0].high, 5);
  EXPECT_TRUE(model_of(joined("floating", ""))->joints.empty());
}

TEST(Urdf, joins_fixed_links_into_one_body) {
  const auto model = model_of(
      robot(link_with_mass("a") + link_with_mass("b") +
            "<joint name='j' type='fixed'><parent link='a'/><child link='b'/><origin xyz='0 0 1'/></joint>"));
  ASSERT_EQ(model->num_bodies(), 1);
  EXPECT_EQ(model->bodies[0].mass_kg, 4);
  EXPECT_EQ(model->bodies[0].pose.position, Vec3(0, 0, 1));
}

TEST(Urdf, stands_fast_without_mass_and_is_free_with_it) {
  EXPECT_EQ(model_of(joined("continuous", ""))->num_bodies(), 1);
  const auto free =
      model_of(robot(link_with_mass("base") + link_with_mass("arm") +
                     "<joint name='j' type='continuous'><parent link='base'/><child link='arm'/></joint>"));
  EXPECT_EQ(free->num_bodies(), 2);
  EXPECT_EQ(free->num_joints(), 1);
  const auto on_world =
      model_of(robot("<link name='world'/>" + link_with_mass("arm") +
                     "<joint name='j' type='fixed'><parent link='world'/><child link='arm'/></joint>" +
                     link_with_mass("hand") +
                     "<joint name='k' type='continuous'><parent link='arm'/><child link='hand'/></joint>"));
  EXPECT_EQ(on_world->num_bodies(), 1);
}

TEST(Urdf, collides_with_others_but_not_with_itself) {
  const std::string ball =
      "<collision><origin xyz='1 0 0'/><geometry><sphere radius='.1'/></geometry></collision>"
      "<visual><geometry><mesh filename='a.stl'/></geometry></visual>";
  const auto model =
      model_of(robot(link_with_mass("a", ball) + link_with_mass("b", ball) + link_with_mass("c", ball) +
                     "<joint name='j' type='continuous'><parent link='a'/><child link='b'/></joint>"
                     "<joint name='k' type='continuous'><parent link='b'/><child link='c'/></joint>"));
  ASSERT_EQ(model->geoms.size(), 3u);
  EXPECT_EQ(model->geoms[0].local.position, Vec3(1, 0, -0.5));
  EXPECT_FALSE(model::TouchRule(*model).may_touch(0, 2));
}

TEST(Urdf, reads_boxes_and_cylinders) {
  const auto shape = [](const std::string& geometry) {
    return model_of(
               robot(link_with_mass("a", "<collision><geometry>" + geometry + "</geometry></collision>")))
        ->geoms[0];
  };
  EXPECT_EQ(shape("<box size='1 2 3'/>").size, (std::array<double, 3>{1, 2, 3}));
  EXPECT_EQ(shape("<cylinder radius='1' length='3'/>").size, (std::array<double, 3>{1, 3, 0}));
  EXPECT_EQ(shape("<cylinder radius='1' length='3'/>").shape, model::Shape::cylinder);
}

struct Refused {
  std::string name;
  std::string xml;
  std::vector<std::string> words;
};

std::ostream& operator<<(std::ostream& out, const Refused& one) { return out << one.name; }

std::vector<Refused> refused() {
  const auto collision = [](const std::string& shape) {
    return robot(link_with_mass("a", "<collision><geometry>\n" + shape + "</geometry></collision>"));
  };
  return {
      {"no_link", robot(""), {"m.xml:1:2", "<link>"}},
      {"mesh", collision("<mesh filename='arm.stl'/>"), {"m.xml:3:2", "arm.stl", "leave_out"}},
      {"no_radius", collision("<sphere/>"), {"m.xml:3:2", "radius"}},
      {"planar", joined("planar", ""), {"m.xml:3:", "planar", "prismatic"}},
      {"unknown_type", joined("revolut", ""), {"m.xml:3:", "revolut", "revolute"}},
      {"no_limit", joined("revolute", ""), {"m.xml:3:", "<limit>"}},
      {"limits_swapped", joined("revolute", "<limit lower='1' upper='0'/>"), {"m.xml:3:", "swap"}},
      {"mimic", joined("continuous", "<mimic joint='k'/>"), {"m.xml:3:", "mimic", "leave_out"}},
      {"axis_of_zero", joined("continuous", "<axis xyz='0 0 0'/>"), {"m.xml:3:", "axis"}},
      {"unknown_child", joined("continuous", "<dynamic/>"), {"m.xml:3:", "dynamic", "dynamics"}},
      {"unknown_element", robot(link_with_mass("a") + "<lnk/>"), {"m.xml:2:", "lnk", "link"}},
      {"ghost",
       robot(link_with_mass("a") +
             "<joint name='j' type='fixed'><parent link='a'/><child link='b'/></joint>"),
       {"m.xml:2:", "'b'"}},
      {"two_roots", robot(link_with_mass("a") + link_with_mass("b")), {"m.xml:2:", "'b'", "one root"}},
      {"ring",
       robot(link_with_mass("a") +
             "<joint name='j' type='fixed'><parent link='a'/><child link='a'/></joint>"),
       {"m.xml:1:", "ring"}},
      {"two_parents",
       robot(link_with_mass("a") + link_with_mass("b") + link_with_mass("c") +
             "<joint name='j' type='fixed'><parent link='a'/><child link='c'/></joint>"
             "<joint name='k' type='fixed'><parent link='b'/><child link='c'/></joint>"),
       {"m.xml:2:", "'c'", "two parents"}},
      {"link_twice", robot(link_with_mass("a") + link_with_mass("a")), {"m.xml:2:", "second link"}},
      {"no_mass",
       robot("<link name='a'/><link name='b'/><joint name='j' type='continuous'><parent link='a'/><child "
             "link='b'/></joint>"),
       {"m.xml:2:", "'b'", "no mass"}},
  };
}

class UrdfRefuses : public testing::TestWithParam<Refused> {};

TEST_P(UrdfRefuses, with_place_and_advice) {
  const std::string message = refusal_of(GetParam().xml);
  EXPECT_NE(message, "");
  for (const std::string& word : GetParam().words)
    EXPECT_NE(message.find(word), std::string::npos) << message;
}

INSTANTIATE_TEST_SUITE_P(Urdf, UrdfRefuses, testing::ValuesIn(refused()),
                         [](const testing::TestParamInfo<Refused>& one) { return one.param.name; });

}  // namespace
}  // namespace pbmpi::scenes
