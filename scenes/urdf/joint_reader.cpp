#include "scenes/urdf/joint_reader.h"

#include <algorithm>

#include "core/text.h"
#include "scenes/urdf/elements.h"
#include "scenes/xml/attributes.h"

namespace pbmpi::scenes::urdf {
namespace {

using links::Motion;
using xml::Attributes;
using xml::Element;
using xml::LeaveOut;
using xml::Range;

Motion motion_of(const std::string& type) {
  if (type == "floating") return Motion::free;
  return type == "prismatic" ? Motion::slide : Motion::hinge;
}

/// `continuous` turns without end; the other types need their range.
void read_limit(const Element& element, const std::string& type, links::LinkJoint& joint,
                const LeaveOut& leave_out) {
  const Element* limit = child_of(element, "limit");
  if (limit == nullptr) {
    if (type == "revolute" || type == "prismatic")
      Attributes(element).fail("it has no <limit>; give one with lower and upper");
    return;
  }
  Attributes range(*limit, leave_out);
  const double low = range.number("lower", Range::any, 0.0), high = range.number("upper", Range::any, 0.0);
  range.allow({"effort", "velocity", "acceleration", "deceleration", "jerk"});
  range.finish(leave_out.notes());
  leave_out.notes().add(
      limit->where, "'effort' and 'velocity' are left out: they bound what drives a joint, and nothing does");
  if (type == "continuous") return;
  if (low > high) range.fail("lower", "'lower' is above 'upper'; swap them");
  joint.limit = {low, high};
}

/// Springs and rotors, which ROS's URDF does not have, act unless they are 0.
void refuse_other_dynamics(Attributes& dynamics) {
  for (const char* name : {"stiffness", "spring_stiffness", "armature", "rotor_inertia"}) {
    if (dynamics.number(name, Range::any, 0.0) != 0)
      dynamics.fail_unless_left_out(name, core::in_quotes(name) + " is not read of a URDF; set it to 0");
  }
  dynamics.allow({"spring_reference", "gear_ratio"});
}

void read_dynamics(const Element& element, links::LinkJoint& joint, const LeaveOut& leave_out) {
  const Element* dynamics = child_of(element, "dynamics");
  if (dynamics == nullptr) return;
  Attributes numbers(*dynamics, leave_out);
  joint.drive.damping = numbers.number("damping", Range::non_negative, 0.0);
  joint.drive.friction = numbers.number("friction", Range::non_negative, 0.0);
  refuse_other_dynamics(numbers);
  numbers.finish(leave_out.notes());
}

Vec3 read_axis(const Element& element, const LeaveOut& leave_out) {
  const Element* axis = child_of(element, "axis");
  if (axis == nullptr) return Vec3::UnitX();
  Attributes attributes(*axis, leave_out);
  Vec3 direction = attributes.direction("xyz", Vec3::UnitX());
  attributes.finish(leave_out.notes());
  return direction;
}

void read_ends(const Element& element, const LeaveOut& leave_out, ReadJoint& read) {
  Attributes parent(need_child(element, "parent"), leave_out), child(need_child(element, "child"), leave_out);
  read.parent = parent.text("link");
  read.child = child.text("link");
  read.parent_where = parent.where("link");
  read.child_where = child.where("link");
  parent.finish(leave_out.notes());
  child.finish(leave_out.notes());
}

void refuse_mimic(const Element& element, const LeaveOut& leave_out) {
  const Element* mimic = child_of(element, "mimic");
  if (mimic == nullptr) return;
  if (!leave_out.names("mimic"))
    xml::refuse_element(*mimic, "a joint that follows another has no equal; take it out");
  leave_out.notes().add(mimic->where, "'mimic' is left out: the joint moves freely");
}

}  // namespace

ReadJoint read_joint(const Element& element, const LeaveOut& leave_out) {
  Attributes attributes(element, leave_out);
  ReadJoint read;
  read.joint.where = element.where;
  read.joint.name = attributes.text("name");
  const std::string type = attributes.text("type");
  const std::vector<std::string> known = {"fixed", "revolute", "continuous", "prismatic", "floating"};
  if (std::ranges::find(known, type) == known.end()) {
    if (type == "planar")
      attributes.fail("type",
                      "joints of type 'planar' have no equal; take two prismatic ones and a link between");
    attributes.fail("type", "unknown type " + core::in_quotes(type) + core::suggestion(type, known));
  }
  attributes.finish(leave_out.notes());
  pass_over_unknown(
      element,
      {"origin", "parent", "child", "axis", "limit", "dynamics", "calibration", "safety_controller", "mimic"},
      leave_out);
  read_ends(element, leave_out, read);
  read.origin = read_origin(element, leave_out);
  read.is_fixed = type == "fixed";
  read.joint.motion = motion_of(type);
  if (read.is_fixed || read.joint.motion == Motion::free) return read;
  refuse_mimic(element, leave_out);
  read.joint.axis = read_axis(element, leave_out);
  read_limit(element, type, read.joint, leave_out);
  read_dynamics(element, read.joint, leave_out);
  return read;
}

}  // namespace pbmpi::scenes::urdf
