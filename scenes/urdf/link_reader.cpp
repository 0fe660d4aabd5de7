#include "scenes/urdf/link_reader.h"

#include <numbers>

#include "core/error.h"
#include "core/text.h"
#include "scenes/links/rigid.h"
#include "scenes/xml/attributes.h"

namespace pbmpi::scenes::urdf {
namespace {

using links::Motion;
using model::Shape;
using xml::Attributes;
using xml::Element;
using xml::Range;

const Element* child_of(const Element& element, std::string_view name) {
  const Element* found = nullptr;
  for (const Element& child : element.children) {
    if (child.name != name) continue;
    core::require_input(found == nullptr, child.where + ": a second <" + child.name + "> here; leave one");
    found = &child;
  }
  return found;
}

const Element& need_child(const Element& element, std::string_view name) {
  const Element* child = child_of(element, name);
  if (child == nullptr) Attributes(element).fail("it has no <" + std::string(name) + ">; give one");
  return *child;
}

/// Refuses child elements that are not read.
void require_children(const Element& element, const std::vector<std::string>& known) {
  for (const Element& child : element.children) {
    if (std::ranges::find(known, child.name) == known.end())
      Attributes(child).fail("unknown element in <" + element.name + ">" +
                             core::suggestion(child.name, known));
  }
}

MassProperties read_inertial(const Element& element) {
  require_children(element, {"origin", "mass", "inertia"});
  Attributes mass(need_child(element, "mass")), inertia(need_child(element, "inertia"));
  const Pose pose = read_origin(element);
  const double ixx = inertia.number("ixx"), iyy = inertia.number("iyy"), izz = inertia.number("izz");
  const double ixy = inertia.number("ixy", Range::any, 0.0), ixz = inertia.number("ixz", Range::any, 0.0),
               iyz = inertia.number("iyz", Range::any, 0.0);
  MassProperties read{mass.number("value", Range::non_negative), Vec3::Zero(), model::Mat3::Zero()};
  read.inertia << ixx, ixy, ixz, ixy, iyy, iyz, ixz, iyz, izz;
  mass.finish();
  inertia.finish();
  return links::moved(read, pose);
}

std::optional<links::LinkGeom> read_collision(const Element& element, const std::set<std::string>& leave_out,
                                              xml::Notes& notes) {
  const Element& geometry = need_child(element, "geometry");
  if (geometry.children.size() != 1) Attributes(geometry).fail("it must hold one shape");
  const Element& shape = geometry.children.front();
  links::LinkGeom geom;
  geom.where = shape.where;
  geom.pose = read_origin(element);
  Attributes size(shape);
  if (shape.name == "box") {
    const core::Vec3 sides = size.vector("size");
    if (!(sides.minCoeff() > 0)) size.fail("size", "'size' must be above 0");
    geom.shape = Shape::box;
    geom.size = {sides.x(), sides.y(), sides.z()};
  } else if (shape.name == "sphere") {
    geom.size[0] = size.number("radius", Range::positive);
  } else if (shape.name == "cylinder" || shape.name == "capsule") {
    geom.shape = shape.name == "cylinder" ? Shape::cylinder : Shape::capsule;
    geom.size = {size.number("radius", Range::positive), size.number("length", Range::positive), 0};
  } else if (leave_out.contains(shape.name)) {
    notes.add(shape.where, "a collision shape of type " + core::in_quotes(shape.name) + " is left out");
    return std::nullopt;
  } else {
    const xml::Attribute* file = shape.find("filename");
    size.fail("this shape" + (file == nullptr ? "" : " (" + file->value + ")") +
              " cannot be collided here; take boxes, spheres and cylinders, or leave it out ('leave_out' of "
              "a TOML scene)");
  }
  size.finish();
  return geom;
}

Motion motion_of(const std::string& type) {
  if (type == "floating") return Motion::free;
  return type == "prismatic" ? Motion::slide : Motion::hinge;
}

/// `continuous` turns without end; the other types need their range.
void read_limit(const Element& element, const std::string& type, links::LinkJoint& joint, xml::Notes& notes) {
  const Element* limit = child_of(element, "limit");
  if (limit == nullptr) {
    if (type == "revolute" || type == "prismatic")
      Attributes(element).fail("it has no <limit>; give one with lower and upper");
    return;
  }
  Attributes range(*limit);
  const double low = range.number("lower", Range::any, 0.0), high = range.number("upper", Range::any, 0.0);
  range.allow({"effort", "velocity"});
  range.finish();
  notes.add(limit->where,
            "'effort' and 'velocity' are left out: they bound what drives a joint, and nothing does");
  if (type == "continuous") return;
  if (low > high) range.fail("lower", "'lower' is above 'upper'; swap them");
  joint.limit = {low, high};
  if (joint.motion != Motion::hinge) return;
  constexpr double half_turn =
      std::numbers::pi;  // larger angles cannot be told apart (ODE manual, "Stops ...")
  if (low < -half_turn || high > half_turn)
    notes.add(limit->where, "a limit of more than half a turn from the start is left out");
  if (low < -half_turn) joint.limit.low = -model::infinity;
  if (high > half_turn) joint.limit.high = model::infinity;
}

void read_dynamics(const Element& element, links::LinkJoint& joint) {
  const Element* dynamics = child_of(element, "dynamics");
  if (dynamics == nullptr) return;
  Attributes numbers(*dynamics);
  joint.drive.damping = numbers.number("damping", Range::non_negative, 0.0);
  joint.drive.friction = numbers.number("friction", Range::non_negative, 0.0);
  numbers.finish();
}

}  // namespace

Pose read_origin(const Element& element) {
  const Element* origin = child_of(element, "origin");
  if (origin == nullptr) return {};
  Attributes attributes(*origin);
  const core::Vec3 angles = attributes.vector("rpy", Vec3(Vec3::Zero()));  // about the fixed axes, x first
  Pose pose;
  pose.position = attributes.vector("xyz", Vec3(Vec3::Zero()));
  const Eigen::Quaterniond turn = rotation(angles.z(), Vec3::UnitZ()).to_eigen() *
                                  rotation(angles.y(), Vec3::UnitY()).to_eigen() *
                                  rotation(angles.x(), Vec3::UnitX()).to_eigen();
  pose.orientation = Quat::from_eigen(turn.normalized());
  attributes.finish();
  return pose;
}

links::Link read_link(const Element& element, const std::set<std::string>& leave_out, xml::Notes& notes) {
  Attributes attributes(element);
  links::Link link;
  link.name = attributes.text("name");
  link.where = element.where;
  attributes.allow({"type"});
  attributes.finish();
  require_children(element,
                   {"inertial", "visual", "collision", "contact", "self_collision_checking", "sensor"});
  if (const Element* inertial = child_of(element, "inertial")) {
    const MassProperties mass = read_inertial(*inertial);
    if (mass.mass_kg > 0) link.mass = mass;
  }
  for (const Element& child : element.children) {
    if (child.name != "collision") continue;
    if (auto geom = read_collision(child, leave_out, notes)) link.geoms.push_back(std::move(*geom));
  }
  return link;
}

ReadJoint read_joint(const Element& element, const std::set<std::string>& leave_out, xml::Notes& notes) {
  Attributes attributes(element);
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
  attributes.finish();
  require_children(element, {"origin", "parent", "child", "axis", "limit", "dynamics", "calibration",
                             "safety_controller", "mimic"});
  Attributes parent(need_child(element, "parent")), child(need_child(element, "child"));
  read.parent = parent.text("link");
  read.child = child.text("link");
  read.parent_where = parent.where("link");
  read.child_where = child.where("link");
  read.origin = read_origin(element);
  read.is_fixed = type == "fixed";
  read.joint.motion = motion_of(type);
  if (const Element* axis = child_of(element, "axis"))
    read.joint.axis = Attributes(*axis).direction("xyz", Vec3::UnitX());
  else
    read.joint.axis = Vec3::UnitX();
  if (const Element* mimic = child_of(element, "mimic")) {
    if (!leave_out.contains("mimic"))
      Attributes(*mimic).fail(
          "a joint that follows another has no equal; take it out, or leave it out ('leave_out' of a TOML "
          "scene)");
    notes.add(mimic->where, "'mimic' is left out: the joint moves freely");
  }
  if (read.is_fixed || read.joint.motion == Motion::free) return read;
  read_limit(element, type, read.joint, notes);
  read_dynamics(element, read.joint);
  return read;
}

}  // namespace pbmpi::scenes::urdf
