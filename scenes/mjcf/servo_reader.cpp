#include "scenes/mjcf/servo_reader.h"

#include <algorithm>
#include <cmath>

#include "core/text.h"

namespace pbmpi::scenes::mjcf {
namespace {

using xml::Attributes;
using xml::Range;

void allow_others(Attributes& actuator) {
  actuator.allow({"name", "class", "group", "user", "lengthrange", "actlimited", "actrange", "actearly"});
  actuator.refuse({"timeconst", "dampratio"}, "the servos here have no such term; give 'kp' and 'kv'");
}

/// MuJoCo clips controls to their range.
double clipped(double control, Attributes& actuator, const Compiler& compiler) {
  if (!compiler.is_limited(actuator, "ctrllimited", "ctrlrange")) return control;
  const std::vector<double> range = actuator.numbers("ctrlrange", 2, 2);
  if (!(range[0] < range[1]))
    actuator.fail("ctrlrange", "the first number of 'ctrlrange' must be below the second");
  return std::clamp(control, range[0], range[1]);
}

/// Alternatively a position servo's control range is its joint's range times a factor.
double clipped_of_position(double control, Attributes& servo, const Compiler& compiler,
                           const links::LinkJoint& joint) {
  const double times = servo.number("inheritrange", Range::non_negative, 0.0);
  const bool inherits = times > 0 && std::isfinite(joint.limit.low) && std::isfinite(joint.limit.high);
  if (!inherits) return clipped(control, servo, compiler);
  servo.allow({"ctrllimited", "ctrlrange"});
  const double middle = (joint.limit.low + joint.limit.high) / 2 + joint.reference;
  const double reach = times * (joint.limit.high - joint.limit.low) / 2;
  return std::clamp(control, middle - reach, middle + reach);
}

/// The rest value of two springs, each of which pulls towards its own value with its own weight.
double balance(double weight, double value, double other_weight, double other_value) {
  const double sum = weight + other_weight;
  return sum > 0 ? (weight * value + other_weight * other_value) / sum : value;
}

}  // namespace

const JointPlace& ActuatorReader::read_driven_joint(Attributes& actuator) {
  for (const char* other : {"tendon", "site", "body", "jointinparent", "cranksite", "slidersite"}) {
    if (actuator.has(other))
      actuator.fail(other, "a servo on a " + core::in_quotes(other) + " has no equal; drive a 'joint'");
  }
  const std::string name = actuator.text("joint");
  if (const auto found = joint_names_.find(joints_, name)) return joints_[static_cast<std::size_t>(*found)];
  actuator.fail("joint",
                "unknown joint " + core::in_quotes(name) + core::suggestion(name, names_of(joints_)));
}

void ActuatorReader::read_servo(const xml::Element& element, double control) {
  const Compiler& compiler = context_.compiler;
  Attributes actuator(element, context_.leave_out, context_.defaults.of(element, ""));
  const JointPlace& at = read_driven_joint(actuator);
  links::LinkJoint& joint =
      mechanism_.links[static_cast<std::size_t>(at.link)].joints[static_cast<std::size_t>(at.joint)];
  if (joint.motion != links::Motion::hinge && joint.motion != links::Motion::slide)
    actuator.fail("joint", "a servo needs a joint of type hinge or slide");
  const std::vector<double> gears = actuator.numbers("gear", 1, 6);
  const double gear = gears.empty() ? 1 : gears[0];
  const bool is_position = element.name == "position";
  control = is_position ? clipped_of_position(control, actuator, compiler, joint)
                        : clipped(control, actuator, compiler);
  const double aim = gear == 0 ? 0 : control / gear;  // target of the joint itself
  links::Drive& drive = joint.drive;
  const double kp = is_position ? actuator.number("kp", Range::non_negative, 1.0) : 0;
  const double kv = actuator.number("kv", Range::non_negative, is_position ? 0.0 : 1.0);
  const double stiffness = kp * gear * gear, damping = kv * gear * gear;
  drive.target = balance(drive.stiffness, drive.target, stiffness, aim - joint.reference);
  drive.velocity = balance(drive.damping, drive.velocity, damping, is_position ? 0 : aim);
  drive.stiffness += stiffness;
  drive.damping += damping;
  const double most = compiler.most_force(actuator, "forcelimited", "forcerange", context_.leave_out.notes());
  if (std::isfinite(most))
    drive.most_force = (std::isinf(drive.most_force) ? 0 : drive.most_force) + most * std::abs(gear);
  drive.most_force = std::min(drive.most_force, at.most_servo_force);
  allow_others(actuator);
  actuator.finish();
}

void ActuatorReader::require_idle(const xml::Element& element, double control) const {
  Attributes actuator(element, context_.leave_out, context_.defaults.of(element, ""));
  if (clipped(control, actuator, context_.compiler) == 0) return;
  const std::string why = control == 0 ? "'ctrlrange' leaves out 0" : "the keyframe gives it a control";
  actuator.fail_unless_left_out(
      "ctrlrange", why + ", so that it always acts, which has no equal; change that", element.name);
}

void ActuatorReader::read(const xml::Element& element, double control) {
  const xml::LeaveOut& leave_out = context_.leave_out;
  const std::string left_out = "actuators of type " + core::in_quotes(element.name) + " are left out";
  if (leave_out.names(element.name)) {
    leave_out.notes().add(element.where, left_out);
  } else if (element.name == "motor" || element.name == "damper" || element.name == "adhesion") {
    require_idle(element, control);
    leave_out.notes().add(element.where, left_out + ": their control is 0, with which they do nothing");
  } else if (element.name == "position" || element.name == "velocity") {
    read_servo(element, control);
  } else if (is_actuator(element.name)) {
    xml::refuse_element(element, "an actuator of this type has no equal; take position, velocity or motor");
  } else {
    xml::refuse_element(element, "unknown element in <actuator>; take it out");
  }
}

}  // namespace pbmpi::scenes::mjcf
