#include "scenes/format/joint_reader.h"

#include <charconv>
#include <cmath>
#include <string>
#include <system_error>
#include <vector>

#include "core/error.h"
#include "core/text.h"
#include "model/joint_traits.h"
#include "model/names.h"
#include "scenes/parts/parts.h"

namespace pbmpi::scenes {
namespace {

using model::JointKind;

constexpr std::string_view world_name = "world";

struct JointSpec {
  std::string name;
  JointKind kind = JointKind::ball;
  std::vector<std::string> bodies;  // two
  std::string bodies_where;
  Vec3 anchor = Vec3::Zero(), axis1 = Vec3::UnitZ(), axis2 = Vec3::UnitX();
  std::array<model::AxisLimit, 2> limits;
  std::array<model::AxisMotor, 2> motors;
  std::array<double, 2> armature{};
  model::Spring suspension;
  double break_force = 0, break_torque = 0;
  int num_copies = 0;  ///< 0: one joint, whose name has no number
  Vec3 spacing = Vec3::Zero();
};

void read_bodies(TableReader& table, JointSpec& joint) {
  joint.bodies = table.texts("bodies");
  joint.bodies_where = table.where("bodies");
  if (joint.bodies.size() != 2) table.fail("bodies", "'bodies' must name two bodies (or one and \"world\")");
  if (joint.bodies[0] == joint.bodies[1]) {
    table.fail("bodies",
               "it joins the body " + core::in_quotes(joint.bodies[0]) + " to itself; name two bodies");
  }
  if (joint.bodies[0] == world_name) table.fail("bodies", "\"world\" must be the second of 'bodies'");
  if (model::traits_of(joint.kind).needs_two_bodies && joint.bodies[1] == world_name) {
    table.fail("bodies", "a " + std::string(model::name_of(joint.kind)) + " needs two bodies, not \"world\"");
  }
}

model::AxisLimit read_limit(TableReader& table, const char* key, JointKind kind) {
  if (!table.has(key)) return {};
  const auto [low, high] = table.pair(key);
  if (low > high) table.fail(key, "the low limit is above the high one; swap them");
  const bool is_angle = !model::traits_of(kind).slides;
  return is_angle ? model::AxisLimit{radians(low), radians(high)} : model::AxisLimit{low, high};
}

model::AxisMotor read_motor(TableReader& table, const char* key) {
  auto motor = table.table(key);
  if (!motor) return {};
  const double velocity = motor->number("velocity", Sign::any);
  const double max_force = motor->number("max_force", Sign::non_negative);
  const double hold_rate = motor->number("hold_rate", Sign::non_negative, 0.0);
  motor->finish();
  return {velocity, max_force, hold_rate};
}

void require_axes_apart(TableReader& table, const JointSpec& joint) {
  const double cosine = std::abs(joint.axis1.dot(joint.axis2));
  constexpr double rounding = 1e-6;  // of a user's digits
  if (model::traits_of(joint.kind).turn == model::HeldTurn::right_angle && cosine > rounding) {
    table.fail("axis2",
               "the axes of a " + std::string(model::name_of(joint.kind)) + " joint must be at right angles");
  }
  if (cosine > 0.999) table.fail("axis2", "the two axes are parallel; turn one");
}

void read_axes(TableReader& table, JointSpec& joint) {
  const model::JointTraits& traits = model::traits_of(joint.kind);
  constexpr const char* limit_keys[] = {"limits", "limits2"};
  constexpr const char* motor_keys[] = {"motor", "motor2"};
  constexpr const char* armature_keys[] = {"armature", "armature2"};
  if (traits.num_axes > 0) joint.axis1 = table.direction("axis");
  if (traits.num_axes > 1) {
    joint.axis2 = table.direction("axis2");
    require_axes_apart(table, joint);
  }
  for (std::size_t axis = 0; axis < traits.axes.size(); ++axis) {
    if (traits.axes[axis].has_limit) joint.limits[axis] = read_limit(table, limit_keys[axis], joint.kind);
    if (traits.axes[axis].has_motor) joint.motors[axis] = read_motor(table, motor_keys[axis]);
    if (traits.axes[axis].has_motor)
      joint.armature[axis] = table.number(armature_keys[axis], Sign::non_negative, 0.0);
  }
  if (traits.has_suspension()) {
    joint.suspension.stiffness = table.number("stiffness", Sign::non_negative, 0.0);
    joint.suspension.damping = table.number("damping", Sign::non_negative, 0.0);
  }
}

/// Reads the strength. A fixed joint needs its anchor only for the torque.
void read_strength(TableReader& table, JointSpec& joint) {
  joint.break_force = table.number("break_force", Sign::non_negative, 0.0);
  joint.break_torque = table.number("break_torque", Sign::non_negative, 0.0);
  const model::JointTraits& traits = model::traits_of(joint.kind);
  const bool is_weld = traits.place == model::HeldPlace::offset && joint.break_torque > 0;
  if (traits.has_anchor() || is_weld) joint.anchor = table.vector("anchor", Sign::any);
}

void read_copies(TableReader& table, JointSpec& joint) {
  if (!table.has("copies")) return;
  joint.num_copies = table.integer("copies", 1);
  joint.spacing = table.vector("spacing", Sign::any);
}

int resolve(const JointSpec& joint, GrowingModel& model, const std::string& name) {
  if (name == world_name) return model::no_body;
  return model.named_body(name, joint.bodies_where + ": joint " + core::in_quotes(joint.name));
}

/// "link.7" for copy 4 of "link.3"; a name that does not end in a number is the same for every copy.
std::string body_of_copy(const std::string& name, int copy) {
  const std::size_t dot = name.rfind('.');
  int number = 0;
  if (dot == std::string::npos) return name;
  const char* const end = name.data() + name.size();
  const auto [stop, error] = std::from_chars(name.data() + dot + 1, end, number);
  if (stop != end || error != std::errc()) return name;
  return name.substr(0, dot + 1) + std::to_string(number + copy);
}

JointSpec copy_of(const JointSpec& spec, int copy) {
  JointSpec result = spec;
  result.name += "." + std::to_string(copy + 1);
  for (std::string& body : result.bodies) body = body_of_copy(body, copy);
  result.anchor += copy * spec.spacing;
  return result;
}

void build_one(const JointSpec& spec, GrowingModel& model) {
  const int a = resolve(spec, model, spec.bodies[0]);
  const int b = resolve(spec, model, spec.bodies[1]);
  model::Joint joint = join(model, spec.name, spec.kind, a, b, spec.anchor, spec.axis1, spec.axis2);
  joint.limits = spec.limits;
  joint.motors = spec.motors;
  joint.armature = spec.armature;
  joint.suspension = spec.suspension;
  joint.break_force = spec.break_force;
  joint.break_torque = spec.break_torque;
  model.joints.push_back(joint);
}

void build(const JointSpec& spec, GrowingModel& model) {
  if (spec.num_copies == 0) build_one(spec, model);
  for (int copy = 0; copy < spec.num_copies; ++copy) build_one(copy_of(spec, copy), model);
}

}  // namespace

JointPlan read_joint(TableReader& table) {
  JointSpec joint;
  joint.name = table.text("name");
  table.set_what("joint " + core::in_quotes(joint.name));
  joint.kind = static_cast<JointKind>(table.choice("kind", model::joint_kind_names));
  read_bodies(table, joint);
  read_strength(table, joint);
  read_axes(table, joint);
  read_copies(table, joint);
  table.finish();
  return [joint](GrowingModel& model) { build(joint, model); };
}

}  // namespace pbmpi::scenes
