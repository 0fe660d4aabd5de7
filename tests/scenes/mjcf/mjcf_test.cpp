#include "scenes/mjcf/mjcf.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "../helpers.h"
#include "models.h"
#include "scenes/parts/mass_properties.h"

namespace pbmpi::scenes {
namespace {

using model::JointKind;
using model::Mat3;
using std::numbers::pi;

constexpr double rounding = 1e-12;  // for numbers of order 1

void expect_near(const Vec3& a, const Vec3& b, double within = rounding) {
  EXPECT_LE((a - b).norm(), within) << a.transpose() << " instead of " << b.transpose();
}

/// The z axis of the one body's frame, in the world.
Vec3 z_of(const std::string& orientation, const std::string& before = "") {
  const auto model = model_of(mujoco(boxed("<freejoint/>", orientation), before));
  return link(*model, "b").pose.direction_to_outer(Vec3::UnitZ());
}

TEST(Mjcf, proposes_its_step_and_gravity) {
  const auto scene = parse_scene(
      {"m", "m.xml", mujoco(boxed("<freejoint/>"), "<option timestep='0.004' gravity='0 1 -2'/>")});
  EXPECT_EQ(scene->defaults().dt_s, 0.004);
  EXPECT_EQ(scene->defaults().steps_per_frame, 8);  // 0.032 s, of 1/30
  expect_near(scene->build(0, 1)->gravity, {0, 1, -2});
  EXPECT_EQ(parse_scene({"m", "m.xml", mujoco(boxed("<freejoint/>"))}, 0.01)->defaults().dt_s, 0.01);
}

TEST(Mjcf, has_the_step_and_gravity_of_mujoco_by_default) {
  const auto scene = parse_scene({"m", "m.xml", mujoco(boxed("<freejoint/>"))});
  EXPECT_EQ(scene->defaults().dt_s, 0.002);
  expect_near(scene->build(0, 1)->gravity, {0, 0, -9.81});
}

TEST(Mjcf, places_bodies_in_each_other) {
  const auto model =
      model_of(mujoco("<body name='a' pos='1 2 3' euler='0 0 1.5707963267948966'>"
                      "<freejoint/><geom size='.1'/>"
                      "<body name='b' pos='1 0 0'><joint/><geom size='.1' pos='0.5 0 0'/></body></body>"));
  expect_near(link(*model, "a").pose.position, {1, 2, 3});
  expect_near(link(*model, "b").pose.position, {1, 3.5, 3});
}

TEST(Mjcf, names_a_body_without_a_name_as_no_other) {
  const std::string free = "<freejoint/><geom size='.1'/></body>";
  const auto model = model_of(mujoco("<body pos='1 0 0'>" + free + "<body name='body1' pos='2 0 0'>" + free +
                                     "<body pos='3 0 0'>" + free));
  expect_near(link(*model, "body1_").pose.position, {1, 0, 0});
  expect_near(link(*model, "body1").pose.position, {2, 0, 0});
  expect_near(link(*model, "body3").pose.position, {3, 0, 0});
}

TEST(Mjcf, reads_every_form_of_an_orientation) {
  const Vec3 tilted(std::sin(0.3), 0, std::cos(0.3));
  expect_near(
      z_of("quat='" + std::to_string(std::cos(0.15)) + " 0 " + std::to_string(std::sin(0.15)) + " 0'"),
      tilted, 1e-5);
  expect_near(z_of("axisangle='0 2 0 0.3'"), tilted);
  expect_near(z_of("euler='0 0.3 0'"), tilted);
  expect_near(z_of("xyaxes='0 1 0 0 0 1'"), {1, 0, 0});
  expect_near(z_of("zaxis='0.3 0 0.4'"), {0.6, 0, 0.8});
  expect_near(z_of("zaxis='0 0 -1'"), {0, 0, -1});
}

TEST(Mjcf, turns_by_degrees_unless_told_otherwise) {
  const auto model =
      model_of("<mujoco><worldbody>" + boxed("<freejoint/>", "euler='0 90 0'") + "</worldbody></mujoco>");
  expect_near(link(*model, "b").pose.direction_to_outer(Vec3::UnitZ()), {1, 0, 0});
}

// Turns about moved axes (lower case) and about fixed axes (upper case) in opposite orders are the same.
TEST(Mjcf, turns_about_moved_and_about_fixed_axes) {
  const Vec3 moved = z_of("euler='0.1 0.2 0.3'", "<compiler eulerseq='xyz'/>");
  const Vec3 fixed = z_of("euler='0.3 0.2 0.1'", "<compiler eulerseq='ZYX'/>");
  expect_near(moved, fixed);
  const Eigen::Matrix3d by_hand =
      (Eigen::AngleAxisd(0.1, Vec3::UnitX()) * Eigen::AngleAxisd(0.2, Vec3::UnitY()) *
       Eigen::AngleAxisd(0.3, Vec3::UnitZ()))
          .toRotationMatrix();
  expect_near(moved, by_hand.col(2));
}

struct ShapeCase {
  std::string geom;
  model::Shape shape;
  std::array<double, 3> size;
  double mass;
};

TEST(Mjcf, gives_geoms_their_sizes_and_masses) {
  const double capsule = 1000 * pi * 0.01 * (0.6 + 4.0 / 3 * 0.1);
  const ShapeCase cases[] = {
      {"size='.1'", model::Shape::sphere, {0.1, 0, 0}, 1000 * 4.0 / 3 * pi * 1e-3},
      {"type='box' size='.1 .2 .3' density='500'", model::Shape::box, {0.2, 0.4, 0.6}, 24},
      {"type='capsule' size='.1 .3'", model::Shape::capsule, {0.1, 0.6, 0}, capsule},
      {"type='capsule' size='.1' fromto='0 0 0 0 0.6 0'", model::Shape::capsule, {0.1, 0.6, 0}, capsule},
      {"type='cylinder' size='.1 .3' mass='7'", model::Shape::cylinder, {0.1, 0.6, 0}, 7},
      {"type='box' size='.1' fromto='0 0 0 0.6 0 0'", model::Shape::box, {0.2, 0.2, 0.6}, 24},
  };
  for (const ShapeCase& one : cases) {
    const auto model = model_of(mujoco("<body name='b'><freejoint/><geom " + one.geom + "/></body>"));
    ASSERT_EQ(model->geoms.size(), 1u) << one.geom;
    EXPECT_EQ(model->geoms[0].shape, one.shape) << one.geom;
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(model->geoms[0].size[i], one.size[i], rounding) << one.geom;
    EXPECT_NEAR(link(*model, "b").mass_kg, one.mass, 1e-9) << one.geom;
    const Vec3 moments = solid_inertia(one.shape, one.size, one.mass).diagonal();
    const Vec3 own = link(*model, "b").inertia.selfadjointView<Eigen::Lower>().eigenvalues();
    Vec3 sorted = moments;
    std::sort(sorted.data(), sorted.data() + 3);
    expect_near(own, sorted, 1e-9);
  }
}

TEST(Mjcf, lays_a_capsule_from_end_to_end) {
  const auto model = model_of(
      mujoco("<body name='b'><freejoint/><geom type='capsule' size='.1' fromto='1 0 0 1 2 0'/></body>"));
  expect_near(link(*model, "b").pose.position, {1, 1, 0});
  const Vec3 axis = model->geoms[0].local.direction_to_outer(Vec3::UnitZ());
  EXPECT_NEAR(std::abs(axis.y()), 1, rounding);
}

TEST(Mjcf, adds_up_the_geoms_of_a_body) {
  const auto model =
      model_of(mujoco("<body name='b'><freejoint/><geom size='.1' mass='1' pos='-1 0 0'/>"
                      "<geom size='.1' mass='3' pos='1 0 0'/></body>"));
  const model::Body& body = link(*model, "b");
  EXPECT_EQ(body.mass_kg, 4);
  expect_near(body.pose.position, {0.5, 0, 0});
  const double own = 0.4 * 4 * 0.01;
  expect_near(body.inertia.diagonal(), {own, own + 1 * 2.25 + 3 * 0.25, own + 3}, 1e-9);
  expect_near(model->geoms[1].local.position, {0.5, 0, 0});
}

TEST(Mjcf, takes_an_inertial_before_geoms) {
  const std::string inertial = "<inertial pos='0 0 .5' mass='2' fullinertia='1 2 2.5 .1 .2 .3'/>";
  const auto model = model_of(mujoco(boxed("<freejoint/>" + inertial)));
  const model::Body& body = link(*model, "b");
  EXPECT_EQ(body.mass_kg, 2);
  expect_near(body.pose.position, {0, 0, 0.5});
  Mat3 inertia;
  inertia << 1, .1, .2, .1, 2, .3, .2, .3, 2.5;
  EXPECT_TRUE(body.inertia.isApprox(inertia, rounding));
  const auto of_geoms =
      model_of(mujoco(boxed("<freejoint/>" + inertial), "<compiler inertiafromgeom='true'/>"));
  EXPECT_EQ(link(*of_geoms, "b").mass_kg, 1);
}

TEST(Mjcf, turns_a_diagonal_inertia_with_its_frame) {
  const auto model = model_of(mujoco(boxed(
      "<freejoint/><inertial pos='0 0 0' mass='2' diaginertia='1 2 2.5' euler='0 0 1.5707963267948966'/>")));
  expect_near(link(*model, "b").inertia.diagonal(), {2, 1, 2.5});
}

TEST(Mjcf, scales_and_bounds_masses_as_the_compiler_says) {
  EXPECT_NEAR(link(*model_of(mujoco(boxed("<freejoint/>"), "<compiler settotalmass='5'/>")), "b").mass_kg, 5,
              rounding);
  const auto bounded =
      model_of(mujoco(boxed("<freejoint/>"), "<compiler boundmass='2' boundinertia='0.03'/>"));
  EXPECT_EQ(link(*bounded, "b").mass_kg, 2);
  // The box of 1 kg has 13/300, 10/300 and 5/300.
  expect_near(link(*bounded, "b").inertia.diagonal(), {13.0 / 300, 10.0 / 300, 0.03});
  const std::string thin = "<inertial pos='0 0 0' mass='2' diaginertia='1 2 6'/>";
  const auto balanced = model_of(mujoco(boxed("<freejoint/>" + thin), "<compiler balanceinertia='true'/>"));
  expect_near(link(*balanced, "b").inertia.diagonal(), {3, 3, 3});
}

TEST(Mjcf, counts_no_mass_of_the_world_and_gives_every_body_the_least) {
  const std::string ground = "<geom type='box' size='9 9 1' pos='0 0 -9'/>";
  EXPECT_NEAR(
      link(*model_of(mujoco(ground + boxed("<freejoint/>"), "<compiler settotalmass='5'/>")), "b").mass_kg, 5,
      rounding);
  const std::string bare = "<body name='b'><freejoint/></body>";
  const auto bounded = model_of(mujoco(bare, "<compiler boundmass='2' boundinertia='0.03'/>"));
  EXPECT_EQ(link(*bounded, "b").mass_kg, 2);
  expect_near(link(*bounded, "b").inertia.diagonal(), {0.03, 0.03, 0.03});
}

TEST(Mjcf, takes_an_inertial_where_there_are_no_geoms_to_take_it_from) {
  const std::string bare =
      "<body name='b'><freejoint/><inertial pos='0 0 0' mass='3' diaginertia='1 1 1'/></body>";
  EXPECT_EQ(link(*model_of(mujoco(bare, "<compiler inertiafromgeom='true'/>")), "b").mass_kg, 3);
}

TEST(Mjcf, takes_attributes_from_classes) {
  const std::string defaults =
      "<default><geom size='.1' density='10'/><default class='heavy'><geom density='100'/>"
      "<default class='big'><geom size='.2'/></default></default></default>";
  const auto mass = [&](const std::string& body, const std::string& geom) {
    return link(*model_of(
                    mujoco("<body name='b' " + body + "><freejoint/><geom " + geom + "/></body>", defaults)),
                "b")
        .mass_kg;
  };
  const double small = 4.0 / 3 * pi * 1e-3;
  EXPECT_NEAR(mass("", ""), 10 * small, rounding);
  EXPECT_NEAR(mass("", "class='heavy'"), 100 * small, rounding);
  EXPECT_NEAR(mass("childclass='big'", ""), 800 * small, rounding);
  EXPECT_NEAR(mass("childclass='big'", "class='heavy'"), 100 * small, rounding);
  EXPECT_NEAR(mass("childclass='big'", "density='1'"), 8 * small, rounding);
}

TEST(Mjcf, makes_a_hinge_with_its_range_from_the_start) {
  const auto model = model_of(
      mujoco(boxed("<joint name='h' axis='0 2 0' pos='0 0 .3' ref='0.5' range='0 1'/>", "pos='0 0 1'")));
  const model::Joint& hinge = joint_of(*model, "h");
  EXPECT_EQ(hinge.kind, JointKind::hinge);
  EXPECT_EQ(hinge.body_b, model::no_body);
  expect_near(hinge.axis1_a, Vec3::UnitY());
  expect_near(hinge.anchor_b, {0, 0, 1.3});
  EXPECT_NEAR(hinge.limits[0].low, -0.5, rounding);
  EXPECT_NEAR(hinge.limits[0].high, 0.5, rounding);
}

TEST(Mjcf, counts_ranges_in_degrees_but_slides_in_metres) {
  const std::string world =
      "<worldbody>" + boxed("<joint name='s' type='slide' range='-2 3'/><joint name='h' range='-90 45'/>") +
      "</worldbody>";
  const auto model = model_of("<mujoco>" + world + "</mujoco>");
  EXPECT_EQ(joint_of(*model, "s").limits[0].high, 3);
  EXPECT_NEAR(joint_of(*model, "h").limits[0].low, -pi / 2, rounding);
}

TEST(Mjcf, limits_only_what_is_limited) {
  const auto is_limited = [&](const std::string& attributes, const std::string& before = "") {
    return joint_of(*model_of(mujoco(boxed("<joint name='h' " + attributes + "/>"), before)), "h")
        .limits[0]
        .active();
  };
  EXPECT_TRUE(is_limited("range='0 1'"));
  EXPECT_FALSE(is_limited("range='0 1' limited='false'"));
  EXPECT_FALSE(is_limited("range='0 1'", "<compiler autolimits='false'/>"));
  EXPECT_TRUE(is_limited("range='0 1' limited='true'", "<compiler autolimits='false'/>"));
  EXPECT_FALSE(is_limited("range='0 1'", "<option><flag limit='disable'/></option>"));
}

TEST(Mjcf, keeps_limits_beyond_half_a_turn) {
  const model::AxisLimit limit =
      joint_of(*model_of(mujoco(boxed("<joint name='h' range='-6 1'/>"))), "h").limits[0];
  EXPECT_EQ(limit.low, -6);
  EXPECT_EQ(limit.high, 1);
}

TEST(Mjcf, makes_balls_and_slides) {
  EXPECT_EQ(joint_of(*model_of(mujoco(boxed("<joint name='j' type='ball'/>"))), "j").kind, JointKind::ball);
  EXPECT_EQ(joint_of(*model_of(mujoco(boxed("<joint name='j' type='slide'/>"))), "j").kind,
            JointKind::slider);
}

TEST(Mjcf, leaves_a_free_body_free) {
  EXPECT_TRUE(model_of(mujoco(boxed("<freejoint/>")))->joints.empty());
  EXPECT_TRUE(model_of(mujoco(boxed("<joint type='free'/>")))->joints.empty());
}

TEST(Mjcf, makes_friction_a_motor_of_that_force) {
  const std::string xml = mujoco(boxed("<joint name='h' frictionloss='2'/>"));
  const model::AxisMotor motor = joint_of(*model_of(xml), "h").motors[0];
  EXPECT_EQ(motor.velocity, 0);
  EXPECT_EQ(motor.max_force, 2);
  EXPECT_EQ(motor.hold_rate, 0);
  EXPECT_TRUE(notes_of(xml).empty()) << "it is exact";
}

TEST(Mjcf, makes_springs_and_dampers_motors_and_says_so) {
  const std::string xml =
      mujoco(boxed("<joint name='h' damping='4' stiffness='20' springref='0.3' ref='0.1'/>"));
  const model::AxisMotor motor = joint_of(*model_of(xml), "h").motors[0];
  EXPECT_EQ(motor.max_force, 20);
  EXPECT_EQ(motor.hold_rate, 5);
  EXPECT_NEAR(motor.velocity, 5 * 0.2, rounding);
  EXPECT_TRUE(says(notes_of(xml), "m.xml:1:"));
  EXPECT_TRUE(says(notes_of(xml), "spring"));
}

TEST(Mjcf, makes_servos_part_of_the_motor) {
  const std::string body = boxed("<joint name='h' damping='1' frictionloss='0.5' ref='0.2'/>");
  const auto motor = [&](const std::string& actuator, const std::string& defaults = "") {
    const std::string xml = "<mujoco><compiler angle='radian'/>" + defaults + "<worldbody>" + body +
                            "</worldbody><actuator>" + actuator + "</actuator></mujoco>";
    return joint_of(*model_of(xml), "h").motors[0];
  };
  const model::AxisMotor position = motor("<position joint='h' kp='30' kv='2' gear='2' forcerange='-5 5'/>");
  EXPECT_EQ(position.hold_rate, 120.0 / 9);  // kp gear^2 / (damping + kv gear^2)
  EXPECT_EQ(position.max_force, 10.5);       // forcerange x gear + friction
  EXPECT_NEAR(position.velocity, 120.0 / 9 * -0.2, rounding);
  const model::AxisMotor velocity = motor("<velocity joint='h' kv='3'/>");
  EXPECT_EQ(velocity.hold_rate, 0);
  EXPECT_EQ(velocity.max_force, 4.5);
  EXPECT_EQ(motor("<motor joint='h'/>").max_force, motor("").max_force);
  EXPECT_EQ(motor("<velocity joint='h'/>", "<default><motor forcerange='-1 1'/></default>").max_force, 1.5)
      << "a default of one actuator is one of all";
}

// A control that nobody sets is 0, which MuJoCo clips to its range: for the knee of a quadruped the range
// does not contain 0.
TEST(Mjcf, aims_servos_at_the_control_that_is_nearest_to_0) {
  const auto motor = [&](const std::string& actuator) {
    const std::string body = boxed("<joint name='h' damping='1' range='-2 -.5' ref='-1'/>");
    return joint_of(*model_of("<mujoco><compiler angle='radian'/><worldbody>" + body +
                              "</worldbody><actuator>" + actuator + "</actuator></mujoco>"),
                    "h")
        .motors[0];
  };
  EXPECT_NEAR(motor("<position joint='h' kp='10' ctrlrange='-1 1'/>").velocity, 10 * 1, rounding);
  EXPECT_NEAR(motor("<position joint='h' kp='10' ctrlrange='-2 -.5'/>").velocity, 10 * 0.5, rounding);
  EXPECT_NEAR(motor("<position joint='h' kp='10' inheritrange='1'/>").velocity, 10 * 0.5, rounding);
  EXPECT_NEAR(motor("<position joint='h' kp='10' ctrllimited='false' ctrlrange='-2 -.5'/>").velocity, 10 * 1,
              rounding);
  // Torques 2 x 3 (0.6 - 3 v) and -v: at rest where they balance.
  EXPECT_NEAR(motor("<velocity joint='h' kv='2' gear='3' ctrlrange='.6 2'/>").velocity, 3.6 / 19, rounding);
}

TEST(Mjcf, bounds_what_servos_of_a_joint_do_together) {
  const auto most = [](const std::string& servos) {
    const std::string body = boxed("<joint name='h' actuatorfrcrange='-7 5'/>");
    return joint_of(*model_of("<mujoco><worldbody>" + body + "</worldbody><actuator>" + servos +
                              "</actuator></mujoco>"),
                    "h")
        .motors[0]
        .max_force;
  };
  const std::string small = "<position joint='h' kp='100' forcerange='-4 4'/>";
  EXPECT_EQ(most("<position joint='h' kp='100'/>"), 7);
  EXPECT_EQ(most(small), 4);
  EXPECT_EQ(most(small + small), 7);
  EXPECT_EQ(most(""), 0);
}

TEST(Mjcf, gives_armatures_to_joints_and_not_to_bodies) {
  const auto with = model_of(mujoco(boxed("<joint name='h' axis='1 0 0' armature='0.5'/>")));
  const auto without = model_of(mujoco(boxed("<joint axis='1 0 0'/>")));
  EXPECT_EQ(joint_of(*with, "h").armature[0], 0.5);
  EXPECT_EQ(link(*with, "b").inertia, link(*without, "b").inertia);
  const auto slide = model_of(mujoco(boxed("<joint name='s' type='slide' armature='0.25'/>")));
  EXPECT_EQ(joint_of(*slide, "s").armature[0], 0.25);
  EXPECT_EQ(link(*slide, "b").mass_kg, 1);
}

TEST(Mjcf, joins_all_worldbodies) {
  const auto model = model_of(
      "<mujoco><worldbody>" + boxed("<freejoint/>") +
      "</worldbody><worldbody><geom type='plane' size='1 1 1'/><body name='c' pos='0 0 3'><freejoint/>"
      "<geom size='.1'/></body></worldbody></mujoco>");
  EXPECT_EQ(model->num_bodies(), 2);
  EXPECT_EQ(model->geoms[0].shape, model::Shape::plane);
}

TEST(Mjcf, leaves_out_attributes_that_the_scene_names) {
  const std::string xml = mujoco(boxed("<freejoint/>", "gravcomp='1'"), "<option speed='9' viscosity='1'/>");
  EXPECT_NE(refusal_of(xml).find("leave_out = [\"viscosity\"]"), std::string::npos) << refusal_of(xml);
  EXPECT_EQ(refusal_of("title = 't'\n[[actor]]\nname = 'm'\ntype = 'model'\nfile = 'a.xml'\n"
                       "leave_out = ['gravcomp', 'viscosity', 'speed']\n[files.'a.xml']\ntext = \"\"\"" +
                       xml + "\"\"\"\n"),
            "");
}

TEST(Mjcf, keeps_what_stands_fast_in_the_world) {
  const auto model =
      model_of(mujoco("<geom type='plane' size='1 1 1' pos='0 0 -1'/>"
                      "<body pos='3 0 0'><geom size='.5'/><body pos='0 1 0'><geom size='.5'/></body></body>" +
                      boxed("<freejoint/>", "pos='0 0 4'")));
  ASSERT_EQ(model->geoms.size(), 4u);
  EXPECT_EQ(model->geoms[0].shape, model::Shape::plane);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(model->geoms[i].body, model::no_body);
  expect_near(model->geoms[2].local.position, {3, 1, 0});
}

TEST(Mjcf, has_the_larger_friction_of_two_geoms) {
  const auto model = model_of(
      mujoco("<geom type='plane' size='1 1 1' friction='0.9'/><body name='b' pos='0 0 1'><freejoint/>"
             "<geom size='.1' friction='0.4 0.1'/></body>"));
  ASSERT_EQ(model->pair_materials.size(), 1u);
  EXPECT_EQ(model->pair_materials[0].material.mu, 0.9);
  EXPECT_EQ(model->geoms[1].material.mu, 0.4);
}

TEST(Mjcf, leaves_out_what_moves_nothing) {
  const std::string xml =
      mujoco("<light/><camera/><site/>" + boxed("<freejoint/><site name='s'/>"),
             "<visual/><statistic extent='1'/><asset><mesh file='a.stl'/></asset><size/><custom/>"
             "<sensor><gyro site='s'/></sensor><keyframe/>"
             "<tendon><fixed name='t'><joint joint='h' coef='1'/></fixed></tendon>"
             "<equality><weld body1='a' active='false'/></equality>");
  EXPECT_EQ(model_of(xml)->num_bodies(), 1);
  EXPECT_TRUE(notes_of(xml).empty());
}

TEST(Mjcf, leaves_out_a_mesh_that_nothing_touches) {
  const std::string xml =
      mujoco(boxed("<freejoint/><geom type='mesh' mesh='m' mass='0' contype='0' conaffinity='0'/>"));
  EXPECT_EQ(model_of(xml)->geoms.size(), 1u);
  EXPECT_TRUE(says(notes_of(xml), "mesh"));
}

}  // namespace
}  // namespace pbmpi::scenes
