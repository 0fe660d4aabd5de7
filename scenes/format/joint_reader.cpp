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

/// A joint as a scene has it: what of it is in body frames follows when its bodies are known.
struct JointSpec {
  model::Joint joint;
  std::vector<std::string> bodies;  // two
  std::string bodies_where;
  Vec3 anchor = Vec3::Zero(), axis1 = Vec3::UnitZ(), axis2 = Vec3::UnitX();
  int num_copies = 0;  ///< 0: one joint, whose name has no number
  Vec3 spacing = Vec3::Zero();
};

void read_bodies(TableReader& table, JointSpec& spec) {
  spec.bodies = table.texts("bodies");
  spec.bodies_where = table.where("bodies");
  if (spec.bodies.size() != 2) table.fail("bodies", "'bodies' must name two bodies (or one and \"world\")");
  if (spec.bodies[0] == spec.bodies[1]) {
    table.fail("bodies",
               "it joins the body " + core::in_quotes(spec.bodies[0]) + " to itself; name two bodies");
  }
  if (spec.bodies[0] == world_name) table.fail("bodies", "\"world\" must be the second of 'bodies'");
  if (model::traits_of(spec.joint.kind).needs_two_bodies && spec.bodies[1] == world_name) {
    table.fail("bodies",
               "a " + std::string(model::name_of(spec.joint.kind)) + " needs two bodies, not \"world\"");
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

void require_axes_apart(TableReader& table, const JointSpec& spec) {
  const double cosine = std::abs(spec.axis1.dot(spec.axis2));
  constexpr double rounding = 1e-6;  // of a user's digits
  if (model::traits_of(spec.joint.kind).turn == model::HeldTurn::right_angle && cosine > rounding) {
    table.fail("axis2", "the axes of a " + std::string(model::name_of(spec.joint.kind)) +
                            " joint must be at right angles");
  }
  if (cosine > 0.999) table.fail("axis2", "the two axes are parallel; turn one");
}

void read_axes(TableReader& table, JointSpec& spec) {
  const model::JointTraits& traits = model::traits_of(spec.joint.kind);
  constexpr const char* limit_keys[] = {"limits", "limits2"};
  constexpr const char* motor_keys[] = {"motor", "motor2"};
  constexpr const char* armature_keys[] = {"armature", "armature2"};
  if (traits.num_axes > 0) spec.axis1 = table.direction("axis");
  if (traits.num_axes > 1) {
    spec.axis2 = table.direction("axis2");
    require_axes_apart(table, spec);
  }
  for (std::size_t axis = 0; axis < traits.axes.size(); ++axis) {
    if (traits.axes[axis].has_limit)
      spec.joint.limits[axis] = read_limit(table, limit_keys[axis], spec.joint.kind);
    if (traits.axes[axis].has_motor) spec.joint.motors[axis] = read_motor(table, motor_keys[axis]);
    if (traits.axes[axis].has_motor)
      spec.joint.armature[axis] = table.number(armature_keys[axis], Sign::non_negative, 0.0);
  }
  if (traits.has_suspension()) {
    spec.joint.suspension.stiffness = table.number("stiffness", Sign::non_negative, 0.0);
    spec.joint.suspension.damping = table.number("damping", Sign::non_negative, 0.0);
  }
}

/// Reads the strength. A fixed joint needs its anchor only for the torque.
void read_strength(TableReader& table, JointSpec& spec) {
  spec.joint.break_force = table.number("break_force", Sign::non_negative, 0.0);
  spec.joint.break_torque = table.number("break_torque", Sign::non_negative, 0.0);
  const model::JointTraits& traits = model::traits_of(spec.joint.kind);
  const bool is_weld = traits.place == model::HeldPlace::offset && spec.joint.break_torque > 0;
  if (traits.has_anchor() || is_weld) spec.anchor = table.vector("anchor", Sign::any);
}

void read_copies(TableReader& table, JointSpec& spec) {
  if (!table.has("copies")) return;
  spec.num_copies = table.integer("copies", 1);
  spec.spacing = table.vector("spacing", Sign::any);
}

int resolve(const JointSpec& spec, GrowingModel& model, const std::string& name) {
  if (name == world_name) return model::no_body;
  return model.named_body(name, spec.bodies_where + ": joint " + core::in_quotes(spec.joint.name),
                          world_name);
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
  result.joint.name += "." + std::to_string(copy + 1);
  for (std::string& body : result.bodies) body = body_of_copy(body, copy);
  result.anchor += copy * spec.spacing;
  return result;
}

void build_one(const JointSpec& spec, GrowingModel& model) {
  const int a = resolve(spec, model, spec.bodies[0]);
  const int b = resolve(spec, model, spec.bodies[1]);
  model.joints.push_back(spec.joint);
  attach(model, a, b, spec.anchor, spec.axis1, spec.axis2, model.joints.back());
}

void build(const JointSpec& spec, GrowingModel& model) {
  if (spec.num_copies == 0) build_one(spec, model);
  for (int copy = 0; copy < spec.num_copies; ++copy) build_one(copy_of(spec, copy), model);
}

}  // namespace

JointPlan read_joint(TableReader& table) {
  JointSpec spec;
  spec.joint.name = table.text("name");
  table.set_what("joint " + core::in_quotes(spec.joint.name));
  spec.joint.kind = static_cast<JointKind>(table.choice("kind", model::joint_kind_names));
  read_bodies(table, spec);
  read_strength(table, spec);
  read_axes(table, spec);
  read_copies(table, spec);
  table.finish();
  return [spec](GrowingModel& model) { build(spec, model); };
}

}  // namespace pbmpi::scenes
