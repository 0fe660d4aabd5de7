// What changes no motion is passed over with a note, and what does is refused unless the scene leaves it out.
#include <gtest/gtest.h>

#include <numbers>

#include "../helpers.h"
#include "../mjcf/models.h"
#include "model/touch_rule.h"

namespace pbmpi::scenes {
namespace {

std::string link_of(const std::string& name, const std::string& more = "",
                    const std::string& moments = "ixx='1' iyy='1.5' izz='2'") {
  return "<link name='" + name + "'><inertial><mass value='2'/><inertia " + moments + "/></inertial>" + more +
         "</link>";
}

std::string two(const std::string& joint, const std::string& attributes = "type='fixed'",
                const std::string& more = "") {
  return "<robot name='r'>\n" + link_of("a") + link_of("b") + "<joint name='j' " + attributes +
         "><parent link='a'/><child link='b'/>" + joint + "</joint>" + more + "</robot>";
}

std::string scene(const std::string& xml, const std::string& keys) {
  return "title = 't'\n[[actor]]\nname = 'm'\ntype = 'model'\nfile = 'm.xml'\n" + keys +
         "\n[files.'m.xml']\ntext = \"\"\"" + xml + "\"\"\"\n";
}

TEST(UrdfAccepts, what_other_tools_add_with_a_note) {
  const std::string limits = "type='revolute' dont_collapse='true'";
  const std::string xml =
      two("<limit lower='-1' upper='1' effort='1' velocity='1' command_effort='8'/><dynamics damping='0' "
          "stiffness='0'/>"
          "<hardwareInterface/>",
          limits, "<self_filter/><gazebo/><drake:diagonal_rotor/>");
  const std::vector<std::string> notes = notes_of(xml);
  for (const char* words :
       {"'dont_collapse' is unknown", "'command_effort' is unknown", "<hardwareInterface> is left out",
        "<self_filter> is left out", "<drake:diagonal_rotor> is left out"})
    EXPECT_TRUE(says(notes, words)) << words;
}

TEST(UrdfAccepts, zero_axes_of_fixed_joints_and_names_of_xml) {
  EXPECT_EQ(refusal_of(two("<axis xyz='0 0 0'/>")), "");
  EXPECT_NE(refusal_of(two("<axis xyz='0 0 0'/>", "type='continuous'")), "");
  EXPECT_EQ(refusal_of("<robot name='r' xmlns:xsi='http://w3' xsi:schemaLocation='a b'>" + link_of("a") +
                       "</robot>"),
            "");
}

TEST(UrdfAccepts, an_orientation_as_a_quaternion) {
  const auto model = model_of(two("<origin xyz='0 0 1' quat_xyzw='0 0 2 0'/>", "type='continuous'"));
  EXPECT_EQ(link(*model, "b").pose.orientation, (core::Quat{0, 0, 0, 1}));
}

TEST(UrdfRefusesStill, what_may_be_a_slip_or_moves_and_says_how_to_leave_it_out) {
  for (const auto& [xml, name] : std::vector<std::pair<std::string, std::string>>{
           {two("<limit lowr='-1' upper='1'/>", "type='revolute'"), "lowr"},
           {two("<dynamics spring_stiffness='3'/>", "type='continuous'"), "spring_stiffness"},
           {two("<lmit/>", "type='continuous'"), "lmit"},
           {two("<mimic joint='k'/>", "type='continuous'"), "mimic"},
           {two("", "type='fixed'", "<loop_joint/>"), "loop_joint"}}) {
    const std::string message = refusal_of(xml);
    EXPECT_NE(message.find("leave_out = [\"" + name + "\"]"), std::string::npos) << message;
    EXPECT_EQ(refusal_of(scene(xml, "leave_out = ['" + name + "']")), "") << name;
  }
  EXPECT_NE(refusal_of(two("", "type='fixed'", "<xacro:wheel/>")).find("xacro"), std::string::npos);
}

TEST(UrdfInertia, must_be_that_of_a_body_up_to_rounding) {
  const auto robot = [](const std::string& moments) {
    return "<robot name='r'>\n" + link_of("a", "", moments) + "</robot>";
  };
  EXPECT_EQ(refusal_of(robot("ixx='1.00' iyy='1.00' izz='2.002'")), "") << "a plate, rounded";
  const std::string impossible = robot("ixx='1' iyy='1' izz='5'");
  EXPECT_NE(refusal_of(impossible).find("m.xml:2:"), std::string::npos);
  EXPECT_NE(refusal_of(impossible).find("sum of the other two"), std::string::npos);
  // The principal moments are 1, 1 and 3: none of the three on the diagonal says so.
  EXPECT_NE(refusal_of(robot("ixx='2' iyy='2' izz='1' ixy='1'")), "");
  const auto model = model_of(scene(impossible, "leave_out = ['inertia']"));
  EXPECT_NEAR(link(*model, "a").inertia(2, 2), 7.0 / 3, 1e-12);
}

/// As a sensor's, to which files give all six numbers alike.
TEST(UrdfInertia, of_a_part_counts_as_it_is_where_the_whole_has_that_of_a_body) {
  const std::string robot =
      "<robot name='r'>" + link_of("a", "", "ixx='1' iyy='1' izz='1'") +
      link_of("imu", "", "ixx='.1' iyy='.1' izz='.1' ixy='.1' ixz='.1' iyz='.1'") +
      "<joint name='j' type='fixed'><parent link='a'/><child link='imu'/></joint></robot>";
  EXPECT_EQ(refusal_of(robot), "");
  EXPECT_NEAR(link(*model_of(robot), "a").inertia(0, 1), 0.1, 1e-12);
}

const std::string ball = "<collision><geometry><sphere radius='.1'/></geometry></collision>";

TEST(UrdfRobot, touches_neither_its_fixed_base_nor_the_rest_of_itself_but_others) {
  const std::string xml =
      "<robot name='r'><link name='world'>" + ball + "</link>" + link_of("arm", ball) +
      link_of("hand", ball) +
      "<joint name='j' type='continuous'><parent link='world'/><child link='arm'/></joint>"
      "<joint name='k' type='continuous'><parent link='arm'/><child link='hand'/></joint></robot>";
  const auto model = model_of(scene(xml, "copies = 2\nspacing = [9, 0, 0]") +
                              "\n[[actor]]\nname = 'g'\ntype = 'ground'\nposition = [0, 0, -5]\n");
  ASSERT_EQ(model->geoms.size(), 7u);
  const model::TouchRule rule(*model);
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) {
      EXPECT_FALSE(rule.may_touch(i, k)) << i << k;
      const bool both_stand = i == 0 && k == 0;
      EXPECT_EQ(rule.may_touch(i, 3 + k), !both_stand) << i << k;
    }
    EXPECT_EQ(rule.may_touch(i, 6), i != 0) << i;
  }
}

TEST(UrdfRobot, starts_where_the_scene_says) {
  const std::string xml =
      "<robot name='r'><link name='base'/>" + link_of("a") + link_of("b") +
      "<joint name='j' type='revolute'><parent link='base'/><child link='a'/><origin xyz='0 0 1'/>"
      "<axis xyz='0 1 0'/><limit lower='-2.7' upper='-0.9'/></joint>"
      "<joint name='k' type='prismatic'><parent link='a'/><child link='b'/><origin xyz='1 0 0'/>"
      "<axis xyz='1 0 0'/><limit lower='0' upper='2'/></joint></robot>";
  EXPECT_TRUE(says(notes_of(xml), "starts outside of its limits"));
  const std::string started = scene(xml, "joints = { j = -90, k = 0.5 }");
  EXPECT_FALSE(says(notes_of(started), "starts outside"));
  const auto model = model_of(started);
  EXPECT_LT((link(*model, "b").pose.position - Vec3(0, 0, 2.5)).norm(), 1e-12);
  const double half_pi = std::numbers::pi / 2;
  EXPECT_NEAR(joint_of(*model, "j").limits[0].low, -2.7 + half_pi, 1e-12);
  EXPECT_NEAR(joint_of(*model, "j").limits[0].high, -0.9 + half_pi, 1e-12);
  EXPECT_EQ(joint_of(*model, "k").limits[0].low, -0.5);
  EXPECT_NE(refusal_of(scene(xml, "joints = { jj = 1 }")).find("m.toml"), 0u);
  EXPECT_NE(refusal_of(scene(xml, "joints = { jj = 1 }")).find("unknown joint 'jj'"), std::string::npos);
  EXPECT_NE(refusal_of(scene(xml, "keyframe = 'a'")).find("no keyframes"), std::string::npos);
}

TEST(UrdfRobot, without_any_mass_says_which_links_need_one) {
  const std::string message = refusal_of(
      "<robot name='r'>\n<link name='a'/><link name='b'/><joint name='j' type='continuous'>"
      "<parent link='a'/><child link='b'/></joint></robot>");
  EXPECT_NE(message.find("m.xml:2:"), std::string::npos) << message;
  EXPECT_NE(message.find("no mass: 'a', 'b'"), std::string::npos) << message;
  EXPECT_NE(message.find("mass and an inertia"), std::string::npos) << message;
}

}  // namespace
}  // namespace pbmpi::scenes
