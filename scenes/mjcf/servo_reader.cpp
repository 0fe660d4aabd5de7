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
  actuator.allow({"name", "class", "group", "user", "lengthrange", "actlimited", "actrange", "actearly"});
  actuator.refuse({"timeconst", "dampratio"}, "the servos here have no such term; give 'kp' and 'kv'");
}

/// MuJoCo clips controls to their range; nothing sets controls here.
double control_of(Attributes& actuator, const Compiler& compiler) {
  if (!compiler.is_limited(actuator, "ctrllimited", "ctrlrange")) return 0;
  const std::vector<double> range = actuator.numbers("ctrlrange", 2, 2);
  if (!(range[0] < range[1]))
    actuator.fail("ctrlrange", "the first number of 'ctrlrange' must be below the second");
  return std::clamp(0.0, range[0], range[1]);
}

/// Alternatively a position servo's control range is its joint's range times a factor.
double control_of_position(Attributes& servo, const Compiler& compiler, const links::LinkJoint& joint,
                           double start) {
  const double times = servo.number("inheritrange", Range::non_negative, 0.0);
  const bool inherits = times > 0 && std::isfinite(joint.limit.low) && std::isfinite(joint.limit.high);
  if (!inherits) return control_of(servo, compiler);
  servo.allow({"ctrllimited", "ctrlrange"});
  const double middle = (joint.limit.low + joint.limit.high) / 2 + start;
  const double reach = times * (joint.limit.high - joint.limit.low) / 2;
  return std::clamp(0.0, middle - reach, middle + reach);
}

/// The rest value of two springs, each of which pulls towards its own value with its own weight.
double balance(double weight, double value, double other_weight, double other_value) {
  const double sum = weight + other_weight;
  return sum > 0 ? (weight * value + other_weight * other_value) / sum : value;
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
  const double control =
      is_position ? control_of_position(actuator, compiler, joint, at.start) : control_of(actuator, compiler);
  const double aim = gear == 0 ? 0 : control / gear;  // target of the joint itself
  links::Drive& drive = joint.drive;
  const double kp = is_position ? actuator.number("kp", Range::non_negative, 1.0) : 0;
  const double kv = actuator.number("kv", Range::non_negative, is_position ? 0.0 : 1.0);
  const double stiffness = kp * gear * gear, damping = kv * gear * gear;
  drive.target = balance(drive.stiffness, drive.target, stiffness, aim - at.start);
  drive.velocity = balance(drive.damping, drive.velocity, damping, is_position ? 0 : aim);
  drive.stiffness += stiffness;
  drive.damping += damping;
  const double most = compiler.most_force(actuator, "forcelimited", "forcerange", notes);
  if (std::isfinite(most))
    drive.most_force = (std::isinf(drive.most_force) ? 0 : drive.most_force) + most * std::abs(gear);
  drive.most_force = std::min(drive.most_force, at.most_servo_force);
  allow_others(actuator);
  actuator.finish();
}

void require_idle(const xml::Element& element, const Defaults& defaults, const Compiler& compiler) {
  Attributes actuator(element, defaults.of(element, ""));
  if (control_of(actuator, compiler) != 0)
    actuator.fail(
        "ctrlrange",
        "'ctrlrange' leaves out 0, so that it always acts, which has no equal; widen it, or leave it "
        "out ('leave_out' of a TOML scene)");
}

}  // namespace

void read_actuators(const xml::Element& element, const Defaults& defaults, const Compiler& compiler,
                    const std::vector<JointPlace>& joints, const std::set<std::string>& leave_out,
                    links::Mechanism& mechanism, xml::Notes& notes) {
  for (const xml::Element& one : element.children) {
    const bool is_idle = one.name == "motor" || one.name == "damper" || one.name == "adhesion";
    if (is_idle || leave_out.contains(one.name)) {
      if (is_idle && !leave_out.contains(one.name)) require_idle(one, defaults, compiler);
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
