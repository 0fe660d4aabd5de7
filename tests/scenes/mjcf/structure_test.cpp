#include <gtest/gtest.h>

#include <map>

#include "models.h"

namespace pbmpi::scenes {
namespace {

using core::Vec3;

/// A scene of the model m.xml, which names these other files.
std::string scene_of(const std::string& xml, const std::map<std::string, std::string>& files) {
  std::string scene = "title = 't'\n[[actor]]\nname = 'm'\ntype = 'model'\nfile = 'm.xml'\n";
  const auto add = [&](const std::string& name, const std::string& text) {
    scene += "[files.'" + name + "']\ntext = \"\"\"" + text + "\"\"\"\n";
  };
  add("m.xml", xml);
  for (const auto& [name, text] : files) add(name, text);
  return scene;
}

void expect_same(const model::Model& a, const model::Model& b) {
  constexpr double rounding = 1e-12;
  ASSERT_EQ(a.num_bodies(), b.num_bodies());
  for (std::size_t i = 0; i < a.bodies.size(); ++i) {
    EXPECT_EQ(a.bodies[i].name, b.bodies[i].name);
    EXPECT_NEAR(a.bodies[i].mass_kg, b.bodies[i].mass_kg, rounding);
    EXPECT_LT((a.bodies[i].pose.position - b.bodies[i].pose.position).norm(), rounding) << a.bodies[i].name;
    const double cosine =
        a.bodies[i].pose.orientation.to_eigen().dot(b.bodies[i].pose.orientation.to_eigen());
    EXPECT_NEAR(std::abs(cosine), 1, rounding) << a.bodies[i].name;
    EXPECT_LT((a.bodies[i].inertia - b.bodies[i].inertia).norm(), rounding) << a.bodies[i].name;
  }
  ASSERT_EQ(a.geoms.size(), b.geoms.size());
  for (std::size_t i = 0; i < a.geoms.size(); ++i) {
    EXPECT_LT((a.geoms[i].local.position - b.geoms[i].local.position).norm(), rounding);
    EXPECT_EQ(a.geoms[i].size, b.geoms[i].size);
  }
  ASSERT_EQ(a.num_joints(), b.num_joints());
  for (std::size_t i = 0; i < a.joints.size(); ++i) {
    EXPECT_EQ(a.joints[i].name, b.joints[i].name);
    EXPECT_LT((a.joints[i].anchor_a - b.joints[i].anchor_a).norm(), rounding) << a.joints[i].name;
    EXPECT_LT((a.joints[i].axis1_a - b.joints[i].axis1_a).norm(), rounding) << a.joints[i].name;
    EXPECT_EQ(a.joints[i].limits[0].high, b.joints[i].limits[0].high) << a.joints[i].name;
    EXPECT_NEAR(a.joints[i].motors[0].max_force, b.joints[i].motors[0].max_force, rounding);
  }
}

const std::string ball = "<freejoint/><geom size='.1'/>";
const std::string quarter = "0.70710678118654752 0 0 0.70710678118654752";  // about z

TEST(Frame, moves_what_is_in_it) {
  const std::string frame = "<frame pos='1 2 0' euler='0 0 1.5707963267948966' childclass='c'>";
  const std::string classes = "<default><default class='c'><geom size='.1'/></default></default>";
  const auto in_frame =
      model_of(mujoco(frame + "<body name='b' pos='1 0 0'><joint/><frame pos='0 0 1'><geom pos='1 0 0'/>"
                              "<joint name='j' pos='0 1 0' axis='1 0 0'/></frame></body></frame>",
                      classes));
  const auto written = model_of(mujoco("<body name='b' pos='1 3 0' quat='" + quarter +
                                       "'><joint/><geom size='.1' pos='1 0 1'/>"
                                       "<joint name='j' pos='0 1 1' axis='1 0 0'/></body>"));
  expect_same(*in_frame, *written);
}

TEST(Frame, turns_the_inertia_that_is_in_it) {
  const std::string inertial = "mass='2' diaginertia='1 2 3'/>";
  expect_same(*model_of(mujoco("<body name='b'><freejoint/><frame pos='0 1 0' quat='" + quarter +
                               "'><inertial pos='1 0 0' " + inertial + "</frame></body>")),
              *model_of(mujoco("<body name='b'><freejoint/><inertial pos='0 2 0' quat='" + quarter + "' " +
                               inertial + "</body>")));
}

TEST(Replicate, makes_copies_each_at_an_offset_and_a_turn_from_the_one_before) {
  const std::string turn = "1.5707963267948966";
  const auto copied = model_of(mujoco("<replicate count='3' offset='1 0 0' euler='0 0 " + turn +
                                      "'><body name='b' pos='0 0 1'>" + ball + "</body></replicate>"));
  const auto written = model_of(
      mujoco("<body name='b0' pos='0 0 1'>" + ball + "</body><body name='b1' pos='1 0 1' quat='" + quarter +
             "'>" + ball + "</body><body name='b2' pos='1 1 1' quat='0 0 0 1'>" + ball + "</body>"));
  expect_same(*copied, *written);
}

TEST(Replicate, numbers_copies_with_equal_digits_innermost_first) {
  const auto model =
      model_of(mujoco("<replicate count='11' offset='2 0 0'><replicate count='2' sep='-' offset='0 2 0'>"
                      "<body name='b' pos='0 0 1'>" +
                      ball + "</body></replicate></replicate>"));
  ASSERT_EQ(model->num_bodies(), 22);
  EXPECT_LT((link(*model, "b-103").pose.position - Vec3(6, 2, 1)).norm(), 1e-12);
}

TEST(Replicate, stands_as_in_the_example_of_mujocos_reference) {
  const std::string turn = "1.5707963267948966";
  const auto model = model_of(mujoco("<replicate count='2' offset='0 1 0' euler='" + turn +
                                     " 0 0'><replicate count='2' sep='-' offset='1 0 0' euler='0 " + turn +
                                     " 0'><body name='b'>" + ball + "</body></replicate></replicate>"));
  const core::Pose& last = link(*model, "b-11").pose;
  EXPECT_LT((last.position - Vec3(1, 1, 0)).norm(), 1e-12);
  EXPECT_NEAR(std::abs(last.orientation.to_eigen().dot(Eigen::Quaterniond(.5, .5, .5, .5))), 1, 1e-12);
  EXPECT_LT((link(*model, "b-10").pose.position - Vec3(1, 0, 0)).norm(), 1e-12);
}

TEST(Replicate, copies_what_names_copies) {
  const std::string arm =
      "<body name='a'><joint name='h' axis='0 1 0'/><geom name='g' size='.1' pos='1 0 0'/>"
      "<body name='b' pos='2 0 0'><joint name='k' axis='0 1 0'/><geom size='.1' pos='1 0 0'/></body></body>";
  const std::string after =
      "</worldbody><actuator><position joint='h' kp='5' kv='5'/></actuator><equality><connect body1='b' "
      "anchor='2 0 0'/></equality><contact><exclude body1='b' body2='a'/></contact><worldbody>";
  const auto model = model_of(mujoco("<replicate count='2' offset='0 1 0'>" + arm + "</replicate>" + after));
  EXPECT_EQ(joint_of(*model, "h0").motors[0].max_force, 5);
  EXPECT_EQ(joint_of(*model, "h1").motors[0].max_force, 5);
  EXPECT_EQ(joint_of(*model, "k1").motors[0].max_force, 0);
  EXPECT_LT((joint_of(*model, "b1-world").anchor_b - Vec3(4, 1, 0)).norm(), 1e-12);
}

TEST(Attach, puts_a_model_into_another_with_settings_and_names_of_its_own) {
  const std::string child =
      "<mujoco model='leg'><compiler angle='degree'/><default><geom size='.2'/></default><worldbody><body "
      "name='root' "
      "pos='0 0 1' euler='0 0 90'><joint name='h' range='0 90'/><geom pos='1 0 0'/></body></worldbody>"
      "<actuator><velocity joint='h' kv='3'/></actuator></mujoco>";
  const auto model = model_of(
      scene_of(mujoco("<body name='trunk' pos='0 1 0'><freejoint/><geom size='.1'/><frame pos='0 0 1'>"
                      "<attach model='leg' body='root' prefix='left/'/></frame></body>",
                      "<asset><model file='parts/leg.xml'/></asset>"),
               {{"parts/leg.xml", child}}));
  const auto written = model_of(mujoco(
      "<body name='trunk' pos='0 1 0'><freejoint/><geom size='.1'/><body name='left/root' pos='0 0 2' "
      "quat='" +
      quarter +
      "'><joint name='left/h' range='0 1.5707963267948966'/><geom size='.2' pos='1 0 0'/></body></body>"
      "</worldbody><actuator><velocity joint='left/h' kv='3'/></actuator><worldbody>"));
  expect_same(*model, *written);
}

TEST(Attach, takes_a_part_of_the_model_itself_and_leaves_out_what_names_the_rest) {
  const auto model =
      model_of(mujoco("<frame name='f' pos='0 0 1'><body name='b'><joint name='h'/><geom size='.1' pos='1 0 "
                      "0'/></body></frame>"
                      "<body name='c' pos='0 9 0'><joint name='k'/><geom size='.1' pos='1 0 0'/></body>"
                      "<frame pos='5 0 0'><attach frame='f' prefix='2'/></frame></worldbody>"
                      "<actuator><velocity joint='h'/><velocity joint='k' kv='7'/></actuator><worldbody>"));
  ASSERT_EQ(model->num_bodies(), 3);
  EXPECT_LT((link(*model, "2b").pose.position - Vec3(6, 0, 1)).norm(), 1e-12);
  EXPECT_EQ(joint_of(*model, "2h").motors[0].max_force, 1);
  EXPECT_EQ(joint_of(*model, "k").motors[0].max_force, 7) << "it is driven once";
}

TEST(Attach, lets_the_model_name_what_it_attaches_and_single_copies) {
  const std::string leg =
      "<mujoco><worldbody><body name='b' pos='0 0 1'><joint name='h'/><geom size='.1' pos='1 0 0'/></body>"
      "</worldbody></mujoco>";
  const auto model =
      model_of(scene_of(mujoco("<attach model='leg' body='b' prefix='l/'/><replicate count='2' offset='3 0 "
                               "0'><body name='r' pos='0 9 0'>"
                               "<joint name='k'/><geom size='.1' pos='1 0 "
                               "0'/></body></replicate></worldbody><actuator><velocity joint='l/h' kv='3'/>"
                               "<velocity joint='k1' kv='5'/></actuator><worldbody>",
                               "<asset><model name='leg' file='leg.xml'/></asset>"),
                        {{"leg.xml", leg}}));
  EXPECT_EQ(joint_of(*model, "l/h").motors[0].max_force, 3);
  EXPECT_EQ(joint_of(*model, "k0").motors[0].max_force, 0);
  EXPECT_EQ(joint_of(*model, "k1").motors[0].max_force, 5);
}

TEST(Attach, takes_a_whole_world) {
  const auto model = model_of(
      scene_of(mujoco("<replicate count='2' offset='3 0 0'><attach model='two' prefix='p'/></replicate>",
                      "<asset><model name='two' file='two.xml'/></asset>"),
               {{"two.xml", "<mujoco><worldbody><geom size='.1'/><body name='b' pos='0 0 1'>" + ball +
                                "</body></worldbody></mujoco>"}}));
  EXPECT_LT((link(*model, "pb1").pose.position - Vec3(3, 0, 1)).norm(), 1e-12);
  EXPECT_EQ(model->geoms.size(), 4u);
}

TEST(Attach, refuses_what_is_not_there_or_has_no_end) {
  const std::string asset = "<asset><model name='a' file='a.xml'/></asset>";
  const std::map<std::string, std::string> files = {
      {"a.xml", "<mujoco><asset><model name='a' file='a.xml'/></asset><worldbody><body name='b'>" + ball +
                    "</body>\n<attach model='a' prefix='x'/></worldbody></mujoco>"}};
  const auto refusal = [&](const std::string& attach) {
    return refusal_of(scene_of(mujoco(boxed("<freejoint/>") + "\n" + attach, asset), files));
  };
  EXPECT_NE(refusal("<attach model='c' prefix='x'/>")
                .find("m.xml:2:9: attach: no <model> of <asset> is called 'c'"),
            std::string::npos)
      << refusal("<attach model='c' prefix='x'/>");
  EXPECT_NE(refusal("<attach model='a' body='d' prefix='x'/>").find("'a.xml' has no body 'd'"),
            std::string::npos);
  EXPECT_NE(refusal("<attach model='a' body='b'/>").find("prefix"), std::string::npos);
  EXPECT_NE(refusal("<attach prefix='x'/>").find("'model', 'body' or 'frame'"), std::string::npos);
  EXPECT_NE(refusal("<attach model='a' prefix='x'/>").find("a.xml:2:2: what is attached attaches itself"),
            std::string::npos);
  const std::string absent = refusal_of(scene_of(mujoco("<attach model='a' prefix='x'/>", asset), {}));
  EXPECT_NE(absent.find("there is no text of 'a.xml'"), std::string::npos) << absent;
}

TEST(Replicate, refuses_more_copies_than_a_model_may_have) {
  const auto refusal = [](const std::string& count) {
    return refusal_of(mujoco("\n<replicate count='" + count + "'><body>" + ball + "</body></replicate>"));
  };
  EXPECT_NE(refusal("1000000000")
                .find("m.xml:2:2: replicate: with all copies the model has more than 1000000 elements"),
            std::string::npos)
      << refusal("1000000000");
  EXPECT_NE(refusal("0").find("whole number from 1 on"), std::string::npos);
  EXPECT_NE(refusal("-3").find("whole number from 1 on"), std::string::npos);
  std::string open, close;
  for (int i = 0; i < 100; ++i) {
    open += "<replicate count='2'>";
    close += "</replicate>";
  }
  EXPECT_NE(refusal_of(mujoco(open + close)).find("more than 1000000"), std::string::npos);
}

}  // namespace
}  // namespace pbmpi::scenes
