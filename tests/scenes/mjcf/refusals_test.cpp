#include <gtest/gtest.h>

#include "models.h"

namespace pbmpi::scenes {
namespace {

struct Refused {
  std::string name;
  std::string xml;
  std::vector<std::string> words;
};

std::ostream& operator<<(std::ostream& out, const Refused& one) { return out << one.name; }

std::string with_actuator(const std::string& actuator) {
  return "<mujoco><worldbody>" + boxed("<joint name='h'/>") + "</worldbody>\n<actuator>" + actuator +
         "</actuator></mujoco>";
}

std::vector<Refused> refused() {
  const auto body = [](const std::string& name, const std::string& in_body, std::vector<std::string> words) {
    return Refused{name, mujoco("\n" + boxed("\n" + in_body)), std::move(words)};
  };
  const auto before = [](const std::string& name, const std::string& text, std::vector<std::string> words) {
    return Refused{name, mujoco(boxed("<freejoint/>"), "\n" + text), std::move(words)};
  };
  return {
      {"not_closed", "<mujoco>\n<worldbody>", {"m.xml:2:", "malformed XML"}},
      {"no_element", "<!-- nothing -->", {"m.xml:", "no"}},
      {"two_roots", mujoco(boxed("")) + "\n<mujoco/>", {"m.xml:2:2", "second root"}},
      {"an_attribute_twice",
       "<mujoco>\n<option timestep='1' timestep='2'/></mujoco>",
       {"m.xml:2:22", "twice"}},
      {"another_root", "<sdf/>", {"m.xml:1:2", "<mujoco>", "<robot>", "sdf"}},
      {"no_world", "<mujoco/>", {"m.xml:1:2", "worldbody"}},
      {"nothing_that_moves", mujoco("<geom size='1'/>"), {"no body"}},
      before("coordinate", "<compiler coordinate='global'/>",
             {"m.xml:2:11", "coordinate", "global", "local"}),
      before("angle", "<compiler angle='grad'/>", {"m.xml:2:11", "grad"}),
      before("eulerseq", "<compiler eulerseq='xyw'/>", {"m.xml:2:11", "eulerseq"}),
      before("misspelt_attribute", "<option timstep='1'/>", {"m.xml:2:9", "timstep", "timestep"}),
      before("step_of_zero", "<option timestep='0'/>", {"m.xml:2:9", "above 0"}),
      before("no_number", "<option timestep='fast'/>", {"m.xml:2:9", "fast", "number"}),
      before("two_signs", "<option gravity='0 0 +-9'/>", {"m.xml:2:9", "+-9", "number"}),
      before("not_finite", "<option timestep='1e999'/>", {"m.xml:2:9", "number"}),
      before("too_few_numbers", "<option gravity='1 2'/>", {"m.xml:2:9", "2 numbers", "3"}),
      before("a_medium", "<option density='1.2'/>", {"m.xml:2:9", "density"}),
      before("a_flag", "<option><flag filterparent='disable'/></option>", {"m.xml:2:", "filterparent"}),
      before("conflict", "<compiler conflict='merge'/>", {"m.xml:2:11", "conflict", "leave_out"}),
      before("include", "<include file='a.xml'/>", {"m.xml:2:2", "no text of 'a.xml'"}),
      before("included_from_elsewhere", "<include file='../a.xml'/>", {"m.xml:2:10", "folder"}),
      before("equality", "<equality><tendon tendon1='t'/></equality>", {"m.xml:2:12", "tendon", "leave_out"}),
      before("connected_ghost", "<equality><connect body1='c' anchor='0 0 0'/></equality>",
             {"m.xml:2:20", "unknown body 'c'", "'b'"}),
      before("tendon", "<tendon><spatial stiffness='1'/></tendon>", {"m.xml:2:10", "spatial", "leave_out"}),
      before("tendon_by_its_class", "<default><tendon stiffness='1'/></default><tendon><fixed/></tendon>",
             {"m.xml:2:", "fixed", "leave_out"}),
      before("contact_pair", "<contact><pair geom1='a' geom2='b'/></contact>",
             {"m.xml:2:16", "unknown geom 'a'"}),
      before("excluded_ghost", "<contact><exclude body1='b' body2='bb'/></contact>",
             {"m.xml:2:29", "bb", "'b'"}),
      before("misspelt_element", "<worldbdy/>", {"m.xml:2:2", "worldbdy", "worldbody"}),
      before("nameless_class", "<default><default><geom/></default></default>", {"m.xml:2:11", "class"}),
      before("class_twice", "<default><default class='a'/><default class='a'/></default>",
             {"m.xml:2:", "second class"}),
      before("default_of_nothing", "<default><gom/></default>", {"m.xml:2:11", "gom"}),
      body("mesh", "<freejoint/><geom type='mesh' mesh='a'/>",
           {"m.xml:3:", "no <mesh> of <asset> is called 'a'"}),
      body("ellipsoid", "<freejoint/><geom type='ellipsoid' size='1 1'/>",
           {"m.xml:3:", "2 numbers instead of 3"}),
      body("fitted_ellipsoid", "<freejoint/><geom type='ellipsoid' mesh='a' size='1 1 1'/>",
           {"m.xml:3:", "three half axes"}),
      body("sdf", "<freejoint/><geom type='sdf' size='1 1 1'/>", {"m.xml:3:", "sdf"}),
      body("mass_of_a_mesh", "<freejoint/><geom type='mesh' mesh='a' contype='0' conaffinity='0'/>",
           {"m.xml:3:", "mass of a geom of type 'mesh'", "<inertial>"}),
      body("hfield", "<freejoint/><geom type='hfield' hfield='a'/>",
           {"m.xml:3:", "no <hfield> of <asset> is called 'a'"}),
      body("no_size", "<freejoint/><geom type='capsule' size='1'/>", {"m.xml:3:", "size", "2 numbers"}),
      body("size_of_zero", "<freejoint/><geom size='0'/>", {"m.xml:3:", "above 0"}),
      body("points_of_a_capsule", "<freejoint/><geom type='capsule' size='1' fromto='0 0 0 0 0 0'/>",
           {"m.xml:3:", "fromto"}),
      body("moving_plane", "<freejoint/><geom type='plane' size='1 1 1'/>", {"m.xml:3:", "plane", "box"}),
      body("hollow", "<freejoint/><geom size='1' shellinertia='true'/>", {"m.xml:3:", "shellinertia"}),
      body("friction_below_zero", "<freejoint/><geom size='1' friction='-1'/>", {"m.xml:3:", "friction"}),
      body("unknown_class", "<freejoint/><geom size='1' class='c'/>", {"m.xml:3:", "class", "'c'"}),
      body("two_orientations", "<geom size='1' quat='1 0 0 0' euler='0 0 0'/>",
           {"m.xml:3:", "euler", "quat"}),
      body("no_quaternion", "<geom size='1' quat='0 0 0 0'/>", {"m.xml:3:", "quat"}),
      body("parallel_axes", "<geom size='1' xyaxes='1 0 0 2 0 0'/>", {"m.xml:3:", "xyaxes"}),
      body("two_inertials",
           "<inertial pos='0 0 0' mass='1' diaginertia='1 1 1'/><inertial pos='0 0 0' mass='1' "
           "diaginertia='1 1 1'/>",
           {"m.xml:3:", "second"}),
      body("inertial_without_place", "<inertial mass='1' diaginertia='1 1 1'/>", {"m.xml:3:", "pos"}),
      body("inertial_of_both_kinds", "<inertial pos='0 0 0' mass='1'/>", {"m.xml:3:", "fullinertia"}),
      body("impossible_inertia", "<inertial pos='0 0 0' mass='1' diaginertia='1 1 3'/>",
           {"m.xml:3:", "sum of the other two"}),
      body("joint_type", "<joint type='gear'/>", {"m.xml:3:", "gear", "hinge"}),
      body("axis_of_zero", "<joint axis='0 0 0'/>", {"m.xml:3:", "axis"}),
      body("range", "<joint range='1 0'/>", {"m.xml:3:", "below"}),
      body("limited_without_range", "<joint limited='true'/>", {"m.xml:3:", "range"}),
      body("range_of_a_ball", "<joint type='ball' range='0 1'/>", {"m.xml:3:", "range", "hinges"}),
      body("damping_of_a_ball", "<joint type='ball' damping='1'/>", {"m.xml:3:", "damping", "hinges"}),
      body("damping_below_zero", "<joint damping='-1'/>", {"m.xml:3:", "at least 0"}),
      body("springdamper", "<joint springdamper='1 1'/>", {"m.xml:3:", "stiffness"}),
      body("free_and_more", "<freejoint/><joint/>", {"m.xml:3:", "no other joint"}),
      body("free_below", "<joint/><body><freejoint/><geom size='1'/></body>", {"m.xml:3:", "worldbody"}),
      body("joint_names", "<joint name='h'/><joint name='h'/>", {"m.xml:3:", "second joint", "'h'"}),
      body("body_names", "<body name='b'><joint/><geom size='1'/></body>",
           {"m.xml:3:", "second body", "'b'"}),
      body("composite", "<composite type='rope'/>", {"m.xml:3:", "composite"}),
      {"frame", mujoco("\n<frame ps='1 0 0'/>"), {"m.xml:2:8", "ps", "'pos'"}},
      {"frame_with_a_name_of_a_class",
       mujoco("\n<frame childclass='c'><geom/></frame>"),
       {"m.xml:2:", "'c'"}},
      {"replicate", mujoco("\n<replicate/>"), {"m.xml:2:2", "count"}},
      {"gravcomp", mujoco(boxed("", "gravcomp='1'")), {"m.xml:1:", "gravcomp"}},
      {"joint_of_the_world", mujoco("<joint/>"), {"m.xml:1:", "world"}},
      {"no_mass", mujoco("<body name='b'><joint/></body>"), {"m.xml:1:", "'b'", "no mass"}},
      {"flat_inertia",
       mujoco("<body name='b'><joint/><inertial pos='0 0 0' mass='1' diaginertia='1 1 0'/></body>"),
       {"'b'", "positive definite"}},
      {"muscle", with_actuator("<muscle joint='h'/>"), {"m.xml:2:", "muscle", "leave_out"}},
      {"no_actuator", with_actuator("<moter joint='h'/>"), {"m.xml:2:", "moter"}},
      {"servo_on_a_site", with_actuator("<position site='s'/>"), {"m.xml:2:", "site", "joint"}},
      {"servo_on_a_ghost", with_actuator("<position joint='g'/>"), {"m.xml:2:", "'g'", "'h'"}},
      {"motor_that_always_acts",
       with_actuator("<motor joint='h' ctrlrange='1 2'/>"),
       {"m.xml:2:", "ctrlrange", "leaves out 0", "leave_out"}},
      {"ctrlrange",
       with_actuator("<position joint='h' ctrlrange='2 1'/>"),
       {"m.xml:2:", "ctrlrange", "below"}},
      {"dampratio", with_actuator("<position joint='h' dampratio='1'/>"), {"m.xml:2:", "dampratio", "kv"}},
  };
}

class MjcfRefuses : public testing::TestWithParam<Refused> {};

TEST_P(MjcfRefuses, with_place_and_advice) {
  const std::string message = refusal_of(GetParam().xml);
  EXPECT_NE(message, "");
  for (const std::string& word : GetParam().words)
    EXPECT_NE(message.find(word), std::string::npos) << message;
}

INSTANTIATE_TEST_SUITE_P(Mjcf, MjcfRefuses, testing::ValuesIn(refused()),
                         [](const testing::TestParamInfo<Refused>& one) { return one.param.name; });

TEST(MjcfRefusal, gives_way_to_leave_out_in_a_scene) {
  const std::string scene =
      "title = 't'\n[[actor]]\nname = 'm'\ntype = 'model'\nfile = 'a.xml'\nleave_out = ['connect', 'mesh', "
      "'muscle']\n"
      "[files.'a.xml']\ntext = \"\"\"<mujoco><worldbody>" +
      boxed("<joint name='h'/><geom type='mesh'/>") +
      "</worldbody><equality><connect body1='b'/></equality><actuator><muscle "
      "joint='h'/></actuator></mujoco>\"\"\"\n";
  EXPECT_EQ(refusal_of(scene), "");
  EXPECT_TRUE(says(notes_of(scene), "a.xml:1:"));
  EXPECT_TRUE(says(notes_of(scene), "'connect' is left out"));
  EXPECT_TRUE(says(notes_of(scene), "muscle"));
}

/// What a default gives to all joints is left out of those that it is not meant for, and of no other.
TEST(MjcfRefusal, of_what_free_joints_have_by_default_gives_way_alone) {
  const std::string text =
      "<mujoco><default><joint damping='2' armature='.1'/></default><worldbody><body name='a'>"
      "<joint type='free'/><geom size='1'/><body name='b' pos='0 0 3'><joint name='h'/><geom size='1'/>"
      "</body></body></worldbody></mujoco>";
  EXPECT_NE(refusal_of(text).find("leave_out = [\"free\"]"), std::string::npos);
  const std::string scene =
      "title = 't'\n[[actor]]\nname = 'm'\ntype = 'model'\nfile = 'a.xml'\nleave_out = ['free']\n"
      "[files.'a.xml']\ntext = \"\"\"" +
      text + "\"\"\"\n";
  EXPECT_EQ(refusal_of(scene), "");
  EXPECT_TRUE(says(notes_of(scene), "'damping' of a joint of type free is left out"));
  EXPECT_EQ(joint_of(*model_of(scene), "h").armature[0], 0.1);
  EXPECT_GT(joint_of(*model_of(scene), "h").motors[0].max_force, 0);
}

TEST(MjcfRefusal, ends_a_tree_that_is_too_deep) {
  std::string open, close;
  for (int i = 0; i < 100000; ++i) {
    open += "<body>";
    close += "</body>";
  }
  EXPECT_NE(refusal_of(mujoco(open + close)).find("500"), std::string::npos);
}

}  // namespace
}  // namespace pbmpi::scenes
