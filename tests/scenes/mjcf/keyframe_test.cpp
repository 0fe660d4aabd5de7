#include "scenes/mjcf/keyframe.h"

#include <gtest/gtest.h>

#include "../helpers.h"
#include "models.h"

namespace pbmpi::scenes {
namespace {

/// A free body with a hinge whose zero in the file is 0.5, a ball and a slide, and keys for them.
std::string keyed(const std::string& keys) {
  return mujoco(
      "<body name='a' pos='0 0 1'><freejoint/><geom size='.1'/>"
      "<body name='b' pos='1 0 0'><joint name='h' axis='0 1 0' ref='.5' range='-2 2.5'/><geom size='.1' "
      "pos='1 0 0'/>"
      "<body name='c' pos='2 0 0'><joint name='k' type='ball'/><geom size='.1' pos='0 0 1'/></body></body>"
      "<body name='d' pos='0 3 0'><joint name='s' type='slide' axis='0 0 1' range='-1 1'/><geom "
      "size='.1'/></body></body>",
      "<keyframe>\n" + keys + "</keyframe><actuator><position name='p' joint='h' kp='10'/></actuator>");
}

std::string scene(const std::string& xml, const std::string& keys) {
  return "title = 't'\n[[actor]]\nname = 'm'\ntype = 'model'\nfile = 'm.xml'\n" + keys +
         "\n[files.'m.xml']\ntext = \"\"\"" + xml + "\"\"\"\n";
}

const std::string home = "<key name='home' qpos='0 0 3 1 0 0 0  .1  0.5 0.5 0.5 0.5  .25' ctrl='.3'/>";

TEST(Keyframe, is_the_start_if_it_is_asked_for) {
  const auto model = model_of(scene(keyed(home), "keyframe = 'home'"));
  EXPECT_EQ(link(*model, "a").pose.position, Vec3(0, 0, 3));
  const double turn = -0.4;  // from ref to .1, about y
  const Vec3 knee = Vec3(1, 0, 3);
  EXPECT_LT((link(*model, "b").pose.position - (knee + Vec3(std::cos(turn), 0, -std::sin(turn)))).norm(),
            1e-12);
  // The ball turns x to y, y to z, z to x: of a geom above its anchor that is ahead, in the frame of b.
  const Vec3 ball = knee + 3 * Vec3(std::cos(turn), 0, -std::sin(turn));
  EXPECT_LT((link(*model, "c").pose.position - ball).norm(), 1e-12);
  EXPECT_LT((link(*model, "d").pose.position - Vec3(0, 3, 3.25)).norm(), 1e-12);
  const model::Joint& hinge = joint_of(*model, "h");
  EXPECT_NEAR(hinge.limits[0].low, -2.1, 1e-12);
  EXPECT_NEAR(hinge.limits[0].high, 2.4, 1e-12);
  EXPECT_NEAR(hinge.motors[0].velocity / hinge.motors[0].hold_rate, 0.2, 1e-12)
      << "the servo's aim, from the start";
  EXPECT_NEAR(joint_of(*model, "s").limits[0].high, 0.75, 1e-12);
}

TEST(Keyframe, gives_way_to_the_joints_of_the_scene) {
  const auto model = model_of(scene(keyed(home), "keyframe = 'home'\njoints = { s = -0.5 }"));
  EXPECT_LT((link(*model, "d").pose.position - Vec3(0, 3, 2.5)).norm(), 1e-12);
}

TEST(Keyframe, is_told_of_where_nothing_starts_from_it) {
  EXPECT_TRUE(says(notes_of(keyed(home)), "m.xml:2:2: the keyframe 'home' is not the start"));
  EXPECT_EQ(link(*model_of(keyed(home)), "a").pose.position, Vec3(0, 0, 1));
}

TEST(Keyframe, that_does_not_fit_is_refused) {
  const auto refusal = [](const std::string& key, const std::string& name = "home") {
    return refusal_of(scene(keyed(key), "keyframe = '" + name + "'"));
  };
  EXPECT_NE(refusal(home, "hom").find("'hom'; did you mean 'home'?"), std::string::npos)
      << refusal(home, "hom");
  EXPECT_NE(refusal("<key name='home' qpos='1 2'/>").find("2 numbers, and the joints have 13"),
            std::string::npos);
  EXPECT_NE(refusal("<key name='home' ctrl='1 2'/>").find("2 numbers for 1 actuators"), std::string::npos);
  EXPECT_NE(refusal("<key name='home' qvel='1'/>").find("leave_out = [\"qvel\"]"), std::string::npos);
  EXPECT_EQ(
      refusal_of(scene(keyed("<key name='home' qvel='1'/>"), "keyframe = 'home'\nleave_out = ['qvel']")), "");
}

}  // namespace
}  // namespace pbmpi::scenes
