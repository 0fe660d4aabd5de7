#include <gtest/gtest.h>

#include <algorithm>

#include "models.h"

namespace pbmpi::scenes {
namespace {

using core::Vec3;
using model::JointKind;

/// Two free balls, of which the second one is turned a quarter about z, and a post that stands fast.
std::string two_balls(const std::string& after) {
  return mujoco(
      "<geom name='floor' type='plane' size='9 9 1' contype='0' conaffinity='0'/><body name='post'><site "
      "name='s'/></body>"
      "<body name='a' pos='1 0 1'><freejoint/><geom name='ga' size='.1' contype='0' conaffinity='0'/></body>"
      "<body name='b' pos='2 0 1' quat='0.70710678118654752 0 0 0.70710678118654752'><freejoint/>"
      "<geom name='gb' size='.1' contype='0' conaffinity='0'/><site name='t' pos='1 0 "
      "0'/></body></worldbody>\n" +
      after + "<worldbody>");
}

std::string equality(const std::string& one) { return two_balls("<equality>" + one + "</equality>"); }

TEST(Equality, connects_two_bodies_where_they_are_in_the_file) {
  const auto model = model_of(equality("<connect body1='a' body2='b' anchor='.5 0 0'/>"));
  const model::Joint& joint = joint_of(*model, "a-b");
  EXPECT_EQ(joint.kind, JointKind::ball);
  EXPECT_LT((joint.anchor_a - Vec3(.5, 0, 0)).norm(), 1e-12);
  EXPECT_LT((joint.anchor_b - Vec3(0, .5, 0)).norm(), 1e-12);
}

TEST(Equality, connects_a_body_with_the_world) {
  const auto model = model_of(equality("<connect body1='b' anchor='0 0 1'/>"));
  EXPECT_EQ(joint_of(*model, "b-world").body_b, model::no_body);
  EXPECT_LT((joint_of(*model, "b-world").anchor_b - Vec3(2, 0, 2)).norm(), 1e-12);
}

TEST(Equality, pulls_sites_together) {
  const std::string xml = equality("<connect site1='t' site2='s'/>");
  const model::Joint joint = joint_of(*model_of(xml), "b-post");
  EXPECT_LT((joint.anchor_a - Vec3(1, 0, 0)).norm(), 1e-12);
  EXPECT_LT(joint.anchor_b.norm(), 1e-12);
  EXPECT_TRUE(says(notes_of(xml), "start apart, and are pulled together"));
}

TEST(Equality, welds_two_bodies_as_they_are_in_the_file) {
  EXPECT_EQ(joint_of(*model_of(equality("<weld body1='a' body2='b'/>")), "a-b").kind, JointKind::fixed);
  const std::string same_pose = "relpose='1 0 0 1 0 0 1'";
  EXPECT_EQ(joint_of(*model_of(equality("<weld body1='a' body2='b' " + same_pose + "/>")), "a-b").kind,
            JointKind::fixed);
  EXPECT_EQ(joint_of(*model_of(equality("<weld body1='a' body2='b' torquescale='0'/>")), "a-b").kind,
            JointKind::ball);
  EXPECT_NE(refusal_of(equality("<weld body1='a' body2='b' relpose='1 0 0 1 0 0 0'/>"))
                .find("m.xml:2:12: a weld holds bodies where they start"),
            std::string::npos);
}

TEST(Equality, takes_no_notice_of_what_is_off_or_holds_one_body) {
  EXPECT_TRUE(model_of(equality("<weld body1='a' active='false'/>"))->joints.empty());
  const std::string one_body = equality("<weld body1='post'/>");
  EXPECT_TRUE(model_of(one_body)->joints.empty());
  EXPECT_TRUE(says(notes_of(one_body), "one body"));
  const std::string disabled =
      mujoco(boxed("<freejoint/>") + "</worldbody><equality><weld body1='b'/></equality><worldbody>",
             "<option><flag equality='disable'/></option>");
  EXPECT_TRUE(model_of(disabled)->joints.empty());
}

TEST(Equality, holds_a_joint_and_refuses_one_that_follows_another) {
  const auto with = [](const std::string& one) {
    return mujoco(boxed("<joint name='h' ref='.1'/>") + "</worldbody>\n<equality>" + one +
                  "</equality><worldbody>");
  };
  const auto model = model_of(with("<joint joint1='h' polycoef='.2 0 0 0 0'/>"));
  EXPECT_EQ(joint_of(*model, "h").limits[0].low, .2);
  EXPECT_EQ(joint_of(*model, "h").limits[0].high, .2);
  EXPECT_NE(refusal_of(with("<joint joint1='h' joint2='h'/>")).find("m.xml:2:29"), std::string::npos);
  EXPECT_NE(refusal_of(with("<joint joint1='g'/>")).find("unknown joint 'g'"), std::string::npos);
}

TEST(Equality, takes_the_defaults_of_equalities_and_not_of_joints) {
  const std::string xml =
      mujoco(boxed("<joint name='h'/>") + "</worldbody><equality><joint joint1='h'/></equality><worldbody>",
             "<default><joint damping='0'/><equality active='false'/></default>");
  EXPECT_FALSE(joint_of(*model_of(xml), "h").limits[0].active());
}

std::string pair(const std::string& attributes) {
  return two_balls("<contact><pair " + attributes + "/></contact>");
}

TEST(Pair, lets_two_geoms_touch_that_would_not) {
  EXPECT_TRUE(model_of(two_balls(""))->geoms.empty());
  const auto model = model_of(pair("geom1='ga' geom2='floor'"));
  ASSERT_EQ(model->geoms.size(), 2u);
  EXPECT_NE(model->geoms[0].actor, model->geoms[1].actor);
}

TEST(Pair, has_the_friction_of_its_geoms) {
  EXPECT_EQ(refusal_of(pair("geom1='ga' geom2='gb' friction='1 1 .01 .01 .01'")), "");
  EXPECT_NE(refusal_of(pair("geom1='ga' geom2='gb' friction='.5'")).find("m.xml:2:38"), std::string::npos)
      << refusal_of(pair("geom1='ga' geom2='gb' friction='.5'"));
  EXPECT_NE(refusal_of(pair("geom1='ga' geom2='gc'")).find("unknown geom 'gc'; did you mean"),
            std::string::npos);
  EXPECT_NE(refusal_of(pair("geom1='ga' geom2='ga'")).find("of one body"), std::string::npos);
  EXPECT_TRUE(says(notes_of(pair("geom1='ga' geom2='gb' gap='1'")), "'gap' of pairs"));
}

model::AxisMotor motor_of(const std::string& actuator) {
  return joint_of(*model_of(mujoco(boxed("<joint name='h'/>") + "</worldbody><actuator>" + actuator +
                                   "</actuator><worldbody>")),
                  "h")
      .motors[0];
}

TEST(Actuators, of_the_general_kind_are_what_their_numbers_say) {
  const model::AxisMotor position = motor_of("<position joint='h' kp='20' kv='4' ctrlrange='.5 1'/>");
  const model::AxisMotor general =
      motor_of("<general joint='h' gainprm='20' biastype='affine' biasprm='0 -20 -4' ctrlrange='.5 1'/>");
  EXPECT_EQ(general.velocity, position.velocity);
  EXPECT_EQ(general.max_force, position.max_force);
  EXPECT_EQ(general.hold_rate, position.hold_rate);
  EXPECT_EQ(motor_of("<general joint='h' biastype='affine' biasprm='0 0 -4'/>").max_force, 4);
  EXPECT_EQ(motor_of("<general joint='h' dyntype='filter' dynprm='1'/>").max_force, 0) << "as a motor at 0";
  EXPECT_EQ(motor_of("<intvelocity joint='h' kp='20' kv='4'/>").max_force, position.max_force);
}

TEST(Actuators, that_push_without_end_are_refused) {
  const auto refusal = [](const std::string& actuator) {
    return refusal_of(mujoco(boxed("<joint name='h'/>") + "</worldbody>\n<actuator>" + actuator +
                             "</actuator><worldbody>"));
  };
  EXPECT_NE(refusal("<general joint='h' biastype='affine' biasprm='3'/>").find("it has a bias"),
            std::string::npos);
  EXPECT_NE(refusal("<general joint='h' dyntype='muscle'/>").find("'dyntype' of this value"),
            std::string::npos);
  EXPECT_NE(refusal("<intvelocity joint='h' ctrlrange='1 2'/>").find("state of its own"), std::string::npos);
}

TEST(Mocap, bodies_stand_where_they_or_a_keyframe_are) {
  const std::string xml = mujoco("<body name='m' mocap='true' pos='1 2 3'><geom size='.1'/></body>" +
                                     boxed("<freejoint/>", "pos='9 0 0'"),
                                 "<keyframe><key name='k' mpos='4 5 6' mquat='0 0 0 1'/></keyframe>");
  EXPECT_EQ(model_of(xml)->geoms[0].body, model::no_body);
  EXPECT_EQ(model_of(xml)->geoms[0].local.position, Vec3(1, 2, 3));
  EXPECT_TRUE(says(notes_of(xml), "'mocap'"));
  const std::string scene =
      "title = 't'\n[[actor]]\nname = 'm'\ntype = 'model'\nfile = 'm.xml'\nkeyframe = 'k'\n"
      "[files.'m.xml']\ntext = \"\"\"" +
      xml + "\"\"\"\n";
  EXPECT_EQ(model_of(scene)->geoms[0].local.position, Vec3(4, 5, 6));
}

TEST(Ellipsoid, that_touches_nothing_has_its_mass) {
  const auto model =
      model_of(mujoco("<body name='b'><freejoint/><geom type='ellipsoid' size='.1 .2 .3' density='1000' "
                      "contype='0' conaffinity='0'/></body>"));
  const double mass = 1000 * 4.0 / 3 * 3.14159265358979 * .1 * .2 * .3;
  EXPECT_NEAR(link(*model, "b").mass_kg, mass, 1e-9);
  EXPECT_NEAR(link(*model, "b").inertia(0, 0), mass / 5 * (.04 + .09), 1e-9);
  EXPECT_TRUE(model->geoms.empty());
}

TEST(Ellipsoid, touches_as_a_hull_with_its_own_mass) {
  const std::string xml = mujoco(
      "<body name='b'><freejoint/><geom type='ellipsoid' size='.1 .2 .3' density='1000' pos='1 0 "
      "0'/></body>");
  const auto model = model_of(xml);
  const model::Geom& geom = model->geoms.at(0);
  EXPECT_EQ(geom.shape, model::Shape::hull);
  for (const model::Vec3& vertex : geom.hull->vertices) {
    const model::Vec3 at = vertex.cwiseQuotient(model::Vec3(.1, .2, .3));
    EXPECT_NEAR(at.norm(), 1,
                1e-3);  // about its centre of mass, which the points only nearly have in the middle
  }
  EXPECT_EQ(geom.hull->vertices.size(), 128u);
  EXPECT_NEAR(link(*model, "b").mass_kg, 1000 * 4.0 / 3 * 3.14159265358979 * .1 * .2 * .3, 1e-9);
  EXPECT_TRUE(says(notes_of(xml), "hull of 128 of its points"));
}

/// As MuJoCo's: the first row at +y, from 0 to the height of `size`.
TEST(HeightField, is_a_mesh_over_its_grid) {
  const auto model = model_of(
      mujoco("<geom type='hfield' hfield='h' pos='0 0 5'/>" + boxed("<freejoint/>"),
             "<asset><hfield name='h' nrow='2' ncol='3' size='3 1 2 .1' elevation='1 1 1 1 5 3'/></asset>"));
  const model::Geom& geom = model->geoms.at(0);
  ASSERT_EQ(geom.shape, model::Shape::mesh);
  EXPECT_EQ(geom.body, model::no_body);
  EXPECT_EQ(geom.hull->faces.size(), 4u);
  const auto height_at = [&](double x, double y) {
    for (const model::Vec3& vertex : geom.hull->vertices) {
      const model::Vec3 at = geom.local.position + vertex;
      if (std::abs(at.x() - x) < 1e-9 && std::abs(at.y() - y) < 1e-9) return at.z() - 5;
    }
    return -1.0;
  };
  EXPECT_NEAR(height_at(0, 1), 0, 1e-12);
  EXPECT_NEAR(height_at(0, -1), 2, 1e-12);
  EXPECT_NEAR(height_at(3, -1), 1, 1e-12);
  EXPECT_NEAR(height_at(-3, -1), 0, 1e-12);
}

TEST(HeightField, without_its_numbers_or_on_a_body_that_moves_is_refused) {
  const auto with = [](const std::string& field, const std::string& world) {
    return refusal_of(
        mujoco(world + boxed("<freejoint/>"), "<asset><hfield name='h' " + field + "/></asset>"));
  };
  const std::string standing = "<geom type='hfield' hfield='h'/>",
                    moving = "<body><freejoint/><geom size='1'/>" + standing + "</body>";
  const auto expect = [](const std::string& refusal, const std::string& words) {
    EXPECT_NE(refusal.find(words), std::string::npos) << refusal;
  };
  expect(with("size='1 1 1 1' nrow='2' ncol='2' elevation='1 2 3'", standing), "nrow x ncol");
  expect(with("size='1 1 1 1' nrow='2' ncol='1'", standing), "from 2 on");
  expect(with("size='1 1 1 1'", standing), "from 2 on");
  expect(with("size='1 1 0 1' nrow='2' ncol='2'", standing), "four numbers above 0");
  expect(with("size='1 1 1 1' file='a.png'", standing), "not read from files");
  expect(with("size='1 1 1 1' nrow='2' ncol='2'", moving), "cannot move");
}

TEST(Flags, take_out_what_they_disable) {
  const auto with = [](const std::string& flag) {
    return model_of(mujoco(boxed("<joint name='h' range='0 1' frictionloss='1' damping='2' stiffness='4'/>"),
                           "<option><flag " + flag + "='disable'/></option>"));
  };
  EXPECT_EQ(joint_of(*with("constraint"), "h").motors[0].max_force, 4);
  EXPECT_FALSE(joint_of(*with("constraint"), "h").limits[0].active());
  EXPECT_EQ(joint_of(*with("passive"), "h").motors[0].max_force, 1);
  EXPECT_EQ(joint_of(*with("spring"), "h").motors[0].max_force, 3);
  EXPECT_EQ(joint_of(*with("frictionloss"), "h").motors[0].max_force, 4);
}

}  // namespace
}  // namespace pbmpi::scenes
