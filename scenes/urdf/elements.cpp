#include "scenes/urdf/elements.h"

#include <algorithm>
#include <array>

#include "core/error.h"
#include "core/text.h"
#include "scenes/xml/attributes.h"

namespace pbmpi::scenes::urdf {

using xml::Attributes;
using xml::Element;
using xml::LeaveOut;

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

void pass_over(const Element& child, const Element& parent, const std::vector<std::string>& known,
               const LeaveOut& leave_out) {
  if (leave_out.drops(child.name, child.where)) return;
  if (child.name.starts_with("xacro:"))
    Attributes(child).fail("this is a xacro file; convert it to URDF with xacro first");
  // What other dialects add to a robot's motion: Drake's and Gazebo's.
  constexpr std::array<std::string_view, 6> moving = {"loop_joint",
                                                      "drake:joint",
                                                      "force_element",
                                                      "drake:linear_spring_damper",
                                                      "drake:linear_bushing_rpy",
                                                      "drake:rotor_inertia"};
  if (std::ranges::find(moving, child.name) != moving.end())
    xml::refuse_element(child, "this element has no equal; take it out");
  constexpr int misspelt = 2;  // letters; longer names that begin alike are other tools'
  if (std::ranges::any_of(
          known, [&](const std::string& name) { return core::edit_distance(child.name, name) <= misspelt; }))
    xml::refuse_element(child, "unknown element in <" + parent.name + ">" +
                                   core::suggestion(child.name, known) + " Rename it");
  leave_out.notes().add(child.where, "<" + child.name + "> is left out");
}

void pass_over_unknown(const Element& element, const std::vector<std::string>& known,
                       const LeaveOut& leave_out) {
  for (const Element& child : element.children) {
    if (std::ranges::find(known, child.name) == known.end()) pass_over(child, element, known, leave_out);
  }
}

Pose read_origin(const Element& element, const LeaveOut& leave_out) {
  const Element* origin = child_of(element, "origin");
  if (origin == nullptr) return {};
  Attributes attributes(*origin, leave_out);
  Pose pose;
  pose.position = attributes.vector("xyz", Vec3(Vec3::Zero()));
  if (attributes.has("quat_xyzw")) {
    if (attributes.has("rpy"))
      attributes.fail("rpy", "'rpy' and 'quat_xyzw' both give the orientation; leave out one");
    pose.orientation = attributes.turn("quat_xyzw", true);
  } else {
    const core::Vec3 angles = attributes.vector("rpy", Vec3(Vec3::Zero()));  // about the fixed axes, x first
    const Eigen::Quaterniond turn = rotation(angles.z(), Vec3::UnitZ()).to_eigen() *
                                    rotation(angles.y(), Vec3::UnitY()).to_eigen() *
                                    rotation(angles.x(), Vec3::UnitX()).to_eigen();
    pose.orientation = Quat::from_eigen(turn.normalized());
  }
  attributes.finish(leave_out.notes());
  return pose;
}

}  // namespace pbmpi::scenes::urdf
