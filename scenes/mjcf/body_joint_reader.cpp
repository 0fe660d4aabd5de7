#include "scenes/mjcf/body_joint_reader.h"

#include "core/text.h"

namespace pbmpi::scenes::mjcf {
namespace {

using links::Motion;
using xml::Attributes;
using xml::Range;

Motion read_motion(Attributes& joint) {
  const std::string type = joint.word("type", {"hinge", "slide", "ball", "free"}, "hinge");
  if (type == "free") return Motion::free;
  if (type == "slide") return Motion::slide;
  return type == "ball" ? Motion::ball : Motion::hinge;
}

/// Reads the limits relative to the pose in the file.
model::AxisLimit read_range(Attributes& joint, bool is_angle, double reference, const Compiler& compiler) {
  const std::vector<double> range = joint.numbers("range", 2, 2);
  if (!(range[0] < range[1])) joint.fail("range", "the first number of 'range' must be below the second");
  const auto from_pose = [&](double value) { return (is_angle ? compiler.angle(value) : value) - reference; };
  return {from_pose(range[0]), from_pose(range[1])};
}

/// Neither a ball joint nor a free body has an axis for a motor or a limit. They often get one by a default
/// that is meant for hinges: the scene may leave those out of the joints of this type alone.
void refuse_axis_laws(Attributes& joint, const xml::LeaveOut& leave_out, links::LinkJoint& read,
                      bool& is_limited) {
  const std::string type = read.motion == Motion::free ? "free" : "ball";
  const auto refuse = [&](std::string_view name, bool is_on) {
    if (!is_on) return;
    if (!leave_out.names(type))
      joint.fail_unless_left_out(
          name, core::in_quotes(name) + " of a joint of type " + type + " has no equal; take hinges", type);
    leave_out.notes().add(joint.where(name),
                          core::in_quotes(name) + " of a joint of type " + type + " is left out");
  };
  refuse("damping", read.drive.damping > 0);
  refuse("stiffness", read.drive.stiffness > 0);
  refuse("frictionloss", read.drive.friction > 0);
  refuse("armature", read.armature > 0);
  refuse("range", is_limited);
  read.drive = {};
  read.armature = 0;
  is_limited = false;
}

}  // namespace

ReadJoint read_joint(Attributes attributes, const std::string& name, const Compiler& compiler,
                     const Option& option, const xml::LeaveOut& leave_out) {
  xml::Notes& notes = leave_out.notes();
  ReadJoint read;
  links::LinkJoint& joint = read.joint;
  joint.where = attributes.where();
  joint.name = attributes.text("name", name);
  joint.motion = read_motion(attributes);
  const bool is_hinge = joint.motion == Motion::hinge, is_slide = joint.motion == Motion::slide;
  joint.anchor = attributes.vector("pos", Vec3(Vec3::Zero()));
  joint.axis = attributes.direction("axis", Vec3::UnitZ());
  const auto value_of = [&](const char* key) {
    const double value = attributes.number(key, Range::any, 0.0);
    return is_hinge ? compiler.angle(value) : value;
  };
  joint.reference = value_of("ref");
  joint.drive.damping = attributes.number("damping", Range::non_negative, 0.0);
  joint.drive.stiffness = attributes.number("stiffness", Range::non_negative, 0.0);
  joint.drive.friction = attributes.number("frictionloss", Range::non_negative, 0.0);
  joint.drive.target = value_of("springref") - joint.reference;
  if (!option.has_dampers) joint.drive.damping = 0;
  if (!option.has_springs) joint.drive.stiffness = 0;
  if (!option.has_friction) joint.drive.friction = 0;
  joint.armature = attributes.number("armature", Range::non_negative, 0.0);
  attributes.allow({"limited", "range"});
  const bool may_have_limits = joint.motion != Motion::free && option.has_limits;
  bool is_limited = may_have_limits && compiler.is_limited(attributes, "limited", "range");
  if (!is_hinge && !is_slide) refuse_axis_laws(attributes, leave_out, joint, is_limited);
  if (is_limited) joint.limit = read_range(attributes, is_hinge, joint.reference, compiler);
  attributes.refuse({"springdamper"}, "give 'stiffness' and 'damping' instead");
  for (const char* key : {"solreflimit", "solimplimit", "solreffriction", "solimpfriction", "margin"}) {
    if (attributes.has(key))
      notes.add(attributes.where(key), core::in_quotes(key) + " of joints is left out: limits are rigid");
  }
  read.most_servo_force = compiler.most_force(attributes, "actuatorfrclimited", "actuatorfrcrange", notes);
  attributes.allow({"class", "group", "user", "actuatorgravcomp"});
  attributes.finish();
  return read;
}

links::LinkJoint read_free_joint(const xml::Element& element, const std::string& name,
                                 const xml::LeaveOut& leave_out) {
  Attributes attributes(element, leave_out);
  links::LinkJoint joint;
  joint.where = attributes.where();
  joint.name = attributes.text("name", name);
  joint.motion = Motion::free;
  attributes.allow({"group", "align"});
  attributes.finish();
  return joint;
}

}  // namespace pbmpi::scenes::mjcf
