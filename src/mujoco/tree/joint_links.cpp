#include "mujoco/tree/joint_links.h"

#include <algorithm>

#include "model/joint_traits.h"

namespace pbmpi::mujoco {
namespace {

using model::Pose;
using model::Vec3;

/// Converts a direction from one frame to another.
Vec3 turn_into(const Pose& to, const Pose& from, const Vec3& direction) {
  return to.orientation.to_eigen().conjugate() * from.direction_to_outer(direction);
}

/// From the joint's second body to its first: axis 2 is fixed in the second, axis 1 and anything that slides
/// along it in the first.
std::vector<LinkAxis> axes_from_b(const model::Joint& joint, const Vec3& axis1, const Vec3& axis2) {
  const model::JointTraits& traits = model::traits_of(joint.kind);
  if (traits.place == model::HeldPlace::anchor && traits.turn == model::HeldTurn::nothing)
    return {{Freedom::ball, axis1, 0}};
  std::vector<LinkAxis> axes;
  if (traits.num_axes > 1) axes.push_back({Freedom::hinge, axis2, 1});
  if (traits.num_axes > 0) axes.push_back({traits.slides ? Freedom::slide : Freedom::hinge, axis1, 0});
  const bool is_sprung = traits.has_suspension() && joint.suspension.stiffness > 0;
  if (is_sprung) axes.push_back({Freedom::slide, axis1, 0, true});
  return axes;
}

Link make_link(const model::Model& model, int body, const Hold& hold) {
  Link link;
  link.hold = hold;
  link.zero = model.bodies[body].pose;
  if (link.is_free()) return link;
  const model::Joint& joint = model.joints[hold.joint];
  const bool child_is_a = joint.body_a == body;
  const Pose child = start_of(model, body), parent = start_of(model, hold.parent);
  const Pose& a = child_is_a ? child : parent;
  const Pose& b = child_is_a ? parent : child;
  link.zero = relative(parent, child);
  link.has_anchor = model::traits_of(joint.kind).has_anchor();
  if (link.has_anchor) {
    link.anchor_child = child_is_a ? joint.anchor_a : joint.anchor_b;
    link.anchor_parent = child_is_a ? joint.anchor_b : joint.anchor_a;
    link.zero.position = link.anchor_parent - link.zero.direction_to_outer(link.anchor_child);
  }
  const double sign = child_is_a ? 1 : -1;
  link.axes = axes_from_b(joint, sign * turn_into(child, a, joint.axis1_a),
                          sign * turn_into(child, b, joint.axis2_b));
  if (!child_is_a) std::ranges::reverse(link.axes);
  return link;
}

}  // namespace

Pose relative(const Pose& outer, const Pose& inner) {
  const Eigen::Quaterniond back = outer.orientation.to_eigen().conjugate();
  return {back * (inner.position - outer.position),
          model::Quat::from_eigen(back * inner.orientation.to_eigen())};
}

int degrees_of_freedom(const std::vector<Link>& links) {
  int sum = 0;
  for (const Link& link : links) {
    if (link.is_free()) sum += 6;
    for (const LinkAxis& axis : link.axes) sum += axis.freedom == Freedom::ball ? 3 : 1;
  }
  return sum;
}

std::vector<Link> make_links(const model::Model& model, const JointTree& tree) {
  std::vector<Link> links;
  links.reserve(model.bodies.size());
  for (int body = 0; body < model.num_bodies(); ++body)
    links.push_back(make_link(model, body, tree.holds[body]));
  return links;
}

}  // namespace pbmpi::mujoco
