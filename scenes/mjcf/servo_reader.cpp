#include "scenes/mjcf/servo_reader.h"

#include <algorithm>
#include <cmath>

#include "core/text.h"

namespace pbmpi::scenes::mjcf {
namespace {

using xml::Attributes;
using xml::Range;

const JointPlace& read_driven_joint(Attributes& actuator, const std::vector<JointPlace>& joints) {
  for (const char* other : {"tendon", "site", "body", "jointinparent", "cranksite", "slidersite"}) {
    if (actuator.has(other))
      actuator.fail(other, "a servo on a " + core::in_quotes(other) + " has no equal; drive a 'joint'");
  }
  const std::string name = actuator.text("joint");
  const auto found = std::ranges::find(joints, name, &JointPlace::name);
  if (found != joints.end()) return *found;
  std::vector<std::string> names;
  names.reserve(joints.size());
  for (const JointPlace& one : joints) names.push_back(one.name);
  actuator.fail("joint", "unknown joint " + core::in_quotes(name) + core::suggestion(name, names));
}

void allow_others(Attributes& actuator) {
  actuator.allow({"name", "class", "group", "ctrllimited", "ctrlrange", "user", "lengthrange", "inheritrange",
                  "actlimited", "actrange", "actearly"});
  actuator.refuse({"timeconst", "dampratio"}, "the servos here have no such term; give 'kp' and 'kv'");
}

/// Adds a spring of this stiffness, at rest at `target`, to what acts on the axis.
void add_spring(double stiffness, double target, links::Drive& drive) {
  const double sum = drive.stiffness + stiffness;
  if (sum > 0) drive.target = (drive.stiffness * drive.target + stiffness * target) / sum;
  drive.stiffness = sum;
}

void read_servo(const xml::Element& element, const Defaults& defaults, const Compiler& compiler,
                const std::vector<JointPlace>& joints, links::Mechanism& mechanism, xml::Notes& notes) {
  Attributes actuator(element, defaults.of(element, ""));
  const JointPlace& at = read_driven_joint(actuator, joints);
  links::LinkJoint& joint =
      mechanism.links[static_cast<std::size_t>(at.link)].joints[static_cast<std::size_t>(at.joint)];
  if (joint.motion != links::Motion::hinge && joint.motion != links::Motion::slide)
    actuator.fail("joint", "a servo needs a joint of type hinge or slide");
  const std::vector<double> gears = actuator.numbers("gear", 1, 6);
  const double gear = gears.empty() ? 1 : gears[0];
  const bool is_position = element.name == "position";
  const double kp = is_position ? actuator.number("kp", Range::non_negative, 1.0) : 0;
  const double kv = actuator.number("kv", Range::non_negative, is_position ? 0.0 : 1.0);
  add_spring(kp * gear * gear, -at.start, joint.drive);
  joint.drive.damping += kv * gear * gear;
  if (compiler.is_limited(actuator, "forcelimited", "forcerange")) {
    const std::vector<double> range = actuator.numbers("forcerange", 2, 2);
    const double most = std::max(std::abs(range[0]), std::abs(range[1])) * std::abs(gear);
    joint.drive.most_force = std::isinf(joint.drive.most_force) ? most : joint.drive.most_force + most;
    if (range[0] != -range[1])
      notes.add(actuator.where("forcerange"),
                "a 'forcerange' that is not even: the larger force holds both ways");
  }
  allow_others(actuator);
  actuator.finish();
}

}  // namespace

void read_actuators(const xml::Element& element, const Defaults& defaults, const Compiler& compiler,
                    const std::vector<JointPlace>& joints, const std::set<std::string>& leave_out,
                    links::Mechanism& mechanism, xml::Notes& notes) {
  for (const xml::Element& one : element.children) {
    const bool is_idle = one.name == "motor" || one.name == "damper" || one.name == "adhesion";
    if (is_idle || leave_out.contains(one.name)) {
      notes.add(one.where, "actuators of type " + core::in_quotes(one.name) + " are left out" +
                               (is_idle ? ": their control is 0, with which they do nothing" : ""));
    } else if (one.name == "position" || one.name == "velocity") {
      read_servo(one, defaults, compiler, joints, mechanism, notes);
    } else if (is_actuator(one.name)) {
      Attributes(one).fail(
          "an actuator of this type has no equal; take position, velocity or motor, or leave it out "
          "('leave_out' of a TOML scene)");
    } else {
      Attributes(one).fail("unknown element in <actuator>");
    }
  }
}

}  // namespace pbmpi::scenes::mjcf
