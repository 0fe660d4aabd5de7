#include "geometry/hulls/hull_contacts.h"

#include <algorithm>
#include <utility>

#include "geometry/geometry.h"

namespace pbmpi::geometry {
namespace {

using model::Shape;

core::Vec3 axis_z(const model::BodyPose& pose) {
  return {pose.rotation[2], pose.rotation[5], pose.rotation[8]};
}

/// A ball's, a capsule's or a cylinder's core about `origin`.
Core core_of(const model::Geom& geom, const model::BodyPose& pose, const core::Vec3& origin) {
  const Extent extent = extent_of(geom);
  return {core::Vec3(pose.position) - origin, axis_z(pose), extent.half[2], extent.ball + extent.disc};
}

/// Does the middle line of a capsule, or the centre of a ball, come into the polyhedron?
bool reaches_in(const Core& core, const Polyhedron& other) {
  double enter = -core.half, leave = core.half;
  for (int face = 0; face < other.num_faces(); ++face) {
    const double height = other.normal(face).dot(core.centre) - other.height(face);
    const double slope = other.normal(face).dot(core.axis);
    if (slope > 0) {
      leave = std::min(leave, -height / slope);
    } else if (slope < 0) {
      enter = std::max(enter, -height / slope);
    } else if (height > 0) {
      return false;
    }
  }
  return enter <= leave;
}

/// Does the point, which is in a face's plane, lie within the face?
bool is_on_face(const Polyhedron& one, int face, const core::Vec3& point) {
  const int count = one.num_corners(face);
  if (count == 0) return false;
  for (int i = 0; i < count; ++i) {
    const core::Vec3 &from = one.corner(face, i), &to = one.corner(face, i + 1 == count ? 0 : i + 1);
    if ((to - from).cross(one.normal(face)).dot(point - from) > 0) return false;
  }
  return true;
}

/// The nearest points of a core that is outside of a polyhedron, and of that.
NearestPoints nearest(const Core& core, const Polyhedron& other) {
  NearestPoints best;
  double least = model::infinity;
  const auto look_at = [&](const NearestPoints& one) {
    const double square = (one.first - one.second).squaredNorm();
    if (!(square < least)) return;
    least = square;
    best = one;
  };
  const core::Vec3 half = core.half * core.axis;
  for (int face = 0; face < other.num_faces(); ++face) {
    for (const core::Vec3& end : {core::Vec3(core.centre - half), core::Vec3(core.centre + half)}) {
      const double height = other.normal(face).dot(end) - other.height(face);
      const core::Vec3 foot = end - height * other.normal(face);
      if (height > 0 && is_on_face(other, face, foot)) look_at({end, foot});
    }
  }
  for (const model::Hull::Edge& edge : other.edges()) {
    const core::Vec3& from = other.vertex(edge.vertices[0]);
    look_at(nearest_of_segments(core.centre - half, 2 * half, from, other.vertex(edge.vertices[1]) - from));
  }
  return best;
}

/// Is it a face of b that has no corners? What touches there is another triangle's affair.
bool is_elsewhere(const LeastOverlap& least, const Polyhedron& b) {
  return least.kind() == LeastOverlap::Kind::face_of_b && b.num_corners(least.first()) == 0;
}

}  // namespace

void HullContacts::meet_round(const Core& a, const Polyhedron& b, ContactPoints& found) {
  core::Vec3 normal;
  double depth = 0;
  constexpr double least_distance = 1e-12;  // [m] below which two points give no direction
  const NearestPoints near = reaches_in(a, b) ? NearestPoints{} : nearest(a, b);
  const core::Vec3 apart = near.first - near.second;
  const double distance = apart.norm();
  if (distance > least_distance) {
    normal = apart / distance;
    depth = a.radius - distance;
    if (depth < -margin_) return;
  } else {
    LeastOverlap least(margin_);
    axes_.separate_capsule(a, b, least);
    if (least.apart() || is_elsewhere(least, b)) return;
    normal = least.normal();
    depth = -least.gap();
  }
  if (a.half > 0) return finder_.meet_capsule(a, b, normal, depth, found);
  found.normal = normal;
  found.add(a.centre - (a.radius - 0.5 * depth) * normal, depth);
}

void HullContacts::meet_cylinder(const Core& a, const Polyhedron& b, ContactPoints& found) {
  LeastOverlap least(margin_);
  axes_.separate_cylinder(a, b, least);
  if (!least.apart() && !is_elsewhere(least, b)) finder_.meet_cylinder(a, b, least, found);
}

void HullContacts::meet(const model::Geom& a, const model::BodyPose& pose, const core::Vec3& origin,
                        const Polyhedron& b, ContactPoints& found) {
  switch (a.shape) {
    case Shape::sphere:
    case Shape::capsule:
      return meet_round(core_of(a, pose, origin), b, found);
    case Shape::cylinder:
      return meet_cylinder(core_of(a, pose, origin), b, found);
    case Shape::plane:
      finder_.lie_on_plane(b, core::Vec3(pose.position) - origin, axis_z(pose), found);
      found.normal = -found.normal;  // out of the plane, so into b
      return;
    case Shape::mesh:  // meets no static geom, and others as b
      return;
    case Shape::box:
    case Shape::hull:
      break;
  }
  a_.place(a, pose, origin);
  LeastOverlap least(margin_);
  axes_.separate(a_, b, least);
  if (!least.apart() && !is_elsewhere(least, b)) finder_.meet(a_, b, least, found);
}

void HullContacts::lie_on(const model::Geom& a, const model::BodyPose& pose, const core::Vec3& origin,
                          const Polyhedron& b, ContactPoints& found) {
  constexpr int face = 0;
  if (a.shape == Shape::sphere || a.shape == Shape::capsule)
    return finder_.lie_capsule_on_face(core_of(a, pose, origin), b, face, found);
  if (a.shape == Shape::cylinder)
    return finder_.lie_cylinder_on_face(core_of(a, pose, origin), b, face, model::infinity, found);
  a_.place(a, pose, origin);
  finder_.lie_on_face(a_, b, face, found);
}

ContactPoints HullContacts::collide(const model::Geom& first, const model::BodyPose& first_pose,
                                    const model::Geom& second, const model::BodyPose& second_pose) {
  ContactPoints found;
  const bool swapped = second.shape != Shape::hull;  // the hull is b
  const model::Geom &a = swapped ? second : first, &b = swapped ? first : second;
  const model::BodyPose &a_pose = swapped ? second_pose : first_pose,
                        &b_pose = swapped ? first_pose : second_pose;
  const core::Vec3 origin(b_pose.position);
  if (!(origin - core::Vec3(a_pose.position)).allFinite()) return found;
  b_.place(b, b_pose, origin);
  meet(a, a_pose, origin, b_, found);
  if (swapped) found.normal = -found.normal;
  for (ContactPoint& point : found.points) point.position += origin;
  return found;
}

model::Contact contact_at(const model::Model& model, const model::GeomPair& pair, const core::Vec3& normal,
                          const ContactPoint& point) {
  const model::Geom& first = model.geoms[static_cast<std::size_t>(pair.first)];
  const model::Geom& second = model.geoms[static_cast<std::size_t>(pair.second)];
  const bool swapped = first.body == model::no_body;  // body a must be a real one
  model::Contact contact;
  contact.body_a = swapped ? second.body : first.body;
  contact.body_b = swapped ? first.body : second.body;
  contact.position = point.position;
  contact.normal = swapped ? core::Vec3(-normal) : normal;
  contact.depth = point.depth;
  const model::Material material = model::pair_material(model, pair, first.material, second.material);
  contact.mu = material.mu;
  contact.restitution = material.restitution;
  contact.geoms = pair;
  return contact;
}

}  // namespace pbmpi::geometry
