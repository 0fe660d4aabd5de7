#include "solver/layout/articulation.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "model/islands.h"
#include "model/joint_traits.h"

namespace pbmpi::solver {
namespace {

using model::HeldPlace;
using model::Joint;
using model::Model;
using model::Pose;
using model::Quat;
using model::Vec3;

Pose start_pose(const Model& model, int body) {
  return body == model::no_body ? Pose{} : model.bodies[static_cast<std::size_t>(body)].pose;
}

Vec3 to_local(const Pose& pose, const Vec3& direction) {
  return pose.orientation.to_eigen().conjugate() * direction;
}

/// The component of `direction` perpendicular to the unit vector `axis`, normalised.
Vec3 across(const Vec3& direction, const Vec3& axis) {
  return (direction - axis * axis.dot(direction)).normalized();
}

JointTerms make_terms(const Model& model, const Joint& joint) {
  const Pose a = start_pose(model, joint.body_a);
  const Pose b = start_pose(model, joint.body_b);
  const model::JointTraits& traits = model::traits_of(joint.kind);
  JointTerms terms;
  terms.anchor_a = joint.anchor_a;
  terms.anchor_b = joint.anchor_b;
  if (traits.place == HeldPlace::offset) {  // the offset of b's centre from a's
    terms.anchor_a = joint.body_b == model::no_body ? Vec3::Zero() : to_local(a, b.position - a.position);
    terms.anchor_b = joint.body_b == model::no_body ? a.position : Vec3::Zero();
  } else if (traits.place == HeldPlace::line) {  // the line goes through this point of b's frame
    terms.anchor_a = Vec3::Zero();
    terms.anchor_b = to_local(b, a.position - b.position);
  }
  const Vec3 axis1 = a.direction_to_outer(joint.axis1_a);
  const Vec3 axis2 = b.direction_to_outer(joint.axis2_b);
  terms.axis1_a = joint.axis1_a;
  terms.axis1_b = to_local(b, axis1);
  terms.axis2_b = joint.axis2_b;
  if (traits.num_axes == 2) {
    terms.normal1_a = across(to_local(a, axis2), terms.axis1_a);
    terms.normal2_b = across(terms.axis1_b, terms.axis2_b);
    terms.cos0 = axis1.dot(axis2);
    terms.sin0 = axis1.cross(axis2).norm();
  } else {
    terms.normal1_a = terms.normal2_b = Vec3::Zero();
  }
  terms.relative = Quat::from_eigen(a.orientation.to_eigen().conjugate() * b.orientation.to_eigen());
  terms.stiffness = joint.suspension.stiffness;
  terms.damping = joint.suspension.damping;
  return terms;
}

/// How many times as easily a force moves a body at this arm [m, its frame] as at its centre.
double leverage(const model::Body& body, const Vec3& arm) {
  model::Mat3 turned;
  turned << 0, -arm.z(), arm.y(), arm.z(), 0, -arm.x(), -arm.y(), arm.x(), 0;
  const model::Mat3 response = turned.transpose() * body.inertia.inverse() * turned;
  return 1 + body.mass_kg * response.norm();
}

/// Do the bodies slide apart until something else stops them?
bool slides_without_end(const Joint& joint) {
  const model::AxisLimit& limit = joint.limits[0];
  return model::traits_of(joint.kind).slides &&
         !(limit.low > -model::infinity && limit.high < model::infinity);
}

/// See ArticulationShape::is_strained.
bool strains(const Model& model, const Joint& joint, const JointTerms& terms) {
  constexpr double most_leverage = 11, greatest_ratio = 100;
  if (slides_without_end(joint)) return true;
  const model::Body& a = model.bodies[static_cast<std::size_t>(joint.body_a)];
  if (leverage(a, terms.anchor_a) > most_leverage) return true;
  if (joint.body_b == model::no_body) return false;
  const model::Body& b = model.bodies[static_cast<std::size_t>(joint.body_b)];
  const double ratio = a.mass_kg / b.mass_kg;
  return leverage(b, terms.anchor_b) > most_leverage || std::max(ratio, 1 / ratio) > greatest_ratio;
}

}  // namespace

std::vector<Articulation> find_articulations(const Model& model) {
  std::vector<std::pair<int, int>> links;
  for (const Joint& joint : model.joints) links.emplace_back(joint.body_a, joint.body_b);
  const model::Islands islands = model::find_islands(model.num_bodies(), links);

  std::vector<Articulation> articulations(static_cast<std::size_t>(islands.count));
  std::vector<int> local(model.bodies.size());
  for (std::size_t body = 0; body < model.bodies.size(); ++body) {
    Articulation& articulation = articulations[static_cast<std::size_t>(islands.of_body[body])];
    local[body] = articulation.shape.num_bodies++;
    articulation.bodies.push_back(static_cast<int>(body));
  }
  for (std::size_t index = 0; index < model.joints.size(); ++index) {
    const Joint& joint = model.joints[index];
    const auto body_a = static_cast<std::size_t>(joint.body_a);
    Articulation& articulation = articulations[static_cast<std::size_t>(islands.of_body[body_a])];
    const int body_b = joint.body_b == model::no_body ? articulation.shape.num_bodies
                                                      : local[static_cast<std::size_t>(joint.body_b)];
    articulation.shape.joints.push_back({joint.kind, local[body_a], body_b, joint.suspension.stiffness > 0,
                                         joint.armature[0] > 0 || joint.armature[1] > 0});
    articulation.terms.push_back(make_terms(model, joint));
    articulation.shape.is_strained |= strains(model, joint, articulation.terms.back());
    articulation.joints.push_back(static_cast<int>(index));
  }
  return articulations;
}

}  // namespace pbmpi::solver
