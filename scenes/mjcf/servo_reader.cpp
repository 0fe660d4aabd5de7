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
  actuator.refuse({"dampratio"}, "the servos here have no such term; give 'kp' and 'kv'");
}

/// MuJoCo clips controls to their range.
double clipped(double control, Attributes& actuator, const Context& context) {
  const bool is_limited = context.compiler.is_limited(actuator, "ctrllimited", "ctrlrange");
  if (!is_limited || !context.option.clips_controls) return control;
  const std::vector<double> range = actuator.numbers("ctrlrange", 2, 2);
  if (!(range[0] < range[1]))
    actuator.fail("ctrlrange", "the first number of 'ctrlrange' must be below the second");
  return std::clamp(control, range[0], range[1]);
}

/// Alternatively a position servo's control range is its joint's range times a factor.
double clipped_of_position(double control, Attributes& servo, const Context& context,
                           const links::LinkJoint& joint) {
  const double times = servo.number("inheritrange", Range::non_negative, 0.0);
  const bool inherits = times > 0 && std::isfinite(joint.limit.low) && std::isfinite(joint.limit.high);
  if (!inherits || !context.option.clips_controls) return clipped(control, servo, context);
  servo.allow({"ctrllimited", "ctrlrange"});
  const double middle = (joint.limit.low + joint.limit.high) / 2 + joint.reference;
  const double reach = times * (joint.limit.high - joint.limit.low) / 2;
  return std::clamp(control, middle - reach, middle + reach);
}

/// What an actuator does along its joint: its force is gain x control + bias - stiffness x coordinate -
/// damping x speed.
struct Law {
  double gain = 0, bias = 0, stiffness = 0, damping = 0;
  bool has_state = false;  ///< does a state, which starts at 0, follow the control and act instead of it?

  bool is_servo() const { return stiffness > 0 || damping > 0; }
};

double first_of(Attributes& actuator, const char* name, std::size_t index, double fallback) {
  const std::vector<double> values = actuator.numbers(name, 1, 20);
  return index < values.size() ? values[index] : fallback;
}

Law read_general(Attributes& general) {
  const auto refuse = [&](const char* name) {
    general.fail(name,
                 core::in_quotes(name) + " of this value has no equal; take position, velocity or motor");
  };
  const std::string state = general.text("dyntype", "none"), gain = general.text("gaintype", "fixed"),
                    bias = general.text("biastype", "none");
  if (state != "none" && state != "integrator" && state != "filter" && state != "filterexact")
    refuse("dyntype");
  if (gain != "fixed" && gain != "affine") refuse("gaintype");
  if (bias != "none" && bias != "affine") refuse("biastype");
  Law law;
  law.has_state = state != "none";
  law.gain = first_of(general, "gainprm", 0, 1);
  for (const std::size_t other : {1, 2}) {
    if (gain == "affine" && first_of(general, "gainprm", other, 0) != 0) refuse("gaintype");
  }
  general.allow({"biasprm", "dynprm", "actdim"});
  if (bias == "none") return law;
  law.bias = first_of(general, "biasprm", 0, 0);
  law.stiffness = -first_of(general, "biasprm", 1, 0);
  law.damping = -first_of(general, "biasprm", 2, 0);
  if (law.stiffness < 0 || law.damping < 0) refuse("biasprm");
  return law;
}

Law read_law(Attributes& actuator, const std::string& type) {
  if (type == "general") return read_general(actuator);
  Law law;
  const bool is_position = type != "velocity";
  law.stiffness = is_position ? actuator.number("kp", Range::non_negative, 1.0) : 0;
  law.damping = actuator.number("kv", Range::non_negative, is_position ? 0.0 : 1.0);
  law.gain = is_position ? law.stiffness : law.damping;
  law.has_state = type == "intvelocity" || actuator.number("timeconst", Range::non_negative, 0.0) > 0;
  return law;
}

/// Refuses what acts without end.
void require_rest(Attributes& actuator, double control, bool has_bias, const Context& context,
                  const std::string& type) {
  const double clipped_control = clipped(control, actuator, context);
  if (clipped_control == 0 && !has_bias) return;
  const std::string why = has_bias       ? "it has a bias"
                          : control == 0 ? "'ctrlrange' leaves out 0"
                                         : "the keyframe gives it a control";
  actuator.fail_unless_left_out(has_bias ? "biasprm" : "ctrlrange",
                                why + ", so that it always acts, which has no equal; change that", type);
}

/// The rest value of two springs, each of which pulls towards its own value with its own weight.
double balance(double weight, double value, double other_weight, double other_value) {
  const double sum = weight + other_weight;
  return sum > 0 ? (weight * value + other_weight * other_value) / sum : value;
}

}  // namespace

void ActuatorReader::read_servo(const xml::Element& element, double control, const Part& part) {
  const xml::LeaveOut& leave_out = part.context->leave_out;
  Attributes actuator(element, leave_out, part.context->defaults.of(element, ""));
  const Law law = read_law(actuator, element.name);
  if (!law.is_servo()) {
    require_rest(actuator, control, law.bias != 0, *part.context, element.name);
    leave_out.notes().add(element.where, "actuators of type " + core::in_quotes(element.name) +
                                             " whose force is 0 at control 0 are left out");
    return;
  }
  for (const char* other : {"tendon", "site", "body", "jointinparent", "cranksite", "slidersite"}) {
    if (actuator.has(other))
      actuator.fail(other, "a servo on a " + core::in_quotes(other) + " has no equal; drive a 'joint'");
  }
  for (const JointPlace* at : joints_.find(actuator, "joint", part))
    drive(actuator, element, control, *at, part);
}

void ActuatorReader::drive(Attributes& actuator, const xml::Element& element, double control,
                           const JointPlace& at, const Part& part) {
  const Context& context = *part.context;
  const Law law = read_law(actuator, element.name);
  links::LinkJoint& joint =
      mechanism_.links[static_cast<std::size_t>(at.link)].joints[static_cast<std::size_t>(at.joint)];
  if (joint.motion != links::Motion::hinge && joint.motion != links::Motion::slide)
    actuator.fail("joint", "a servo needs a joint of type hinge or slide");
  const double gear = first_of(actuator, "gear", 0, 1);
  control = law.stiffness > 0 ? clipped_of_position(control, actuator, context, joint)
                              : clipped(control, actuator, context);
  if (law.has_state && control != 0)
    actuator.fail("ctrlrange",
                  "a servo with a state of its own has no equal, except at control 0; change that");
  const double holds = law.stiffness > 0 ? law.stiffness : law.damping;
  const double aim = gear == 0 ? 0 : (law.gain / holds * control + law.bias / holds) / gear;  // of the joint
  links::Drive& drive = joint.drive;
  const double stiffness = law.stiffness * gear * gear, damping = law.damping * gear * gear;
  drive.target = balance(drive.stiffness, drive.target, stiffness, aim - joint.reference);
  drive.velocity = balance(drive.damping, drive.velocity, damping, law.stiffness > 0 ? 0 : aim);
  drive.stiffness += stiffness;
  drive.damping += damping;
  const double most =
      context.compiler.most_force(actuator, "forcelimited", "forcerange", context.leave_out.notes());
  if (std::isfinite(most))
    drive.most_force = (std::isinf(drive.most_force) ? 0 : drive.most_force) + most * std::abs(gear);
  drive.most_force = std::min(drive.most_force, at.most_servo_force);
  allow_others(actuator);
  actuator.finish();
}

void ActuatorReader::read(const xml::Element& element, double control, const Part& part) {
  const xml::LeaveOut& leave_out = part.context->leave_out;
  const std::string left_out = "actuators of type " + core::in_quotes(element.name) + " are left out";
  if (leave_out.names(element.name)) {
    leave_out.notes().add(element.where, left_out);
  } else if (element.name == "motor" || element.name == "damper" || element.name == "adhesion") {
    Attributes actuator(element, leave_out, part.context->defaults.of(element, ""));
    require_rest(actuator, control, false, *part.context, element.name);
    leave_out.notes().add(element.where, left_out + ": their control is 0, with which they do nothing");
  } else if (element.name == "position" || element.name == "velocity" || element.name == "intvelocity" ||
             element.name == "general") {
    read_servo(element, control, part);
  } else if (is_actuator(element.name)) {
    xml::refuse_element(element, "an actuator of this type has no equal; take position, velocity or motor");
  } else {
    xml::refuse_element(element, "unknown element in <actuator>; take it out");
  }
}

}  // namespace pbmpi::scenes::mjcf
