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

}  // namespace

void HullContacts::meet_round(const Core& a, ContactPoints& found) {
  core::Vec3 normal;
  double depth = 0;
  constexpr double least_distance = 1e-12;  // [m] below which two points give no direction
  const NearestPoints near = reaches_in(a, b_) ? NearestPoints{} : nearest(a, b_);
  const core::Vec3 apart = near.first - near.second;
  const double distance = apart.norm();
  if (distance > least_distance) {
    normal = apart / distance;
    depth = a.radius - distance;
    if (depth < -margin_) return;
  } else {
    LeastOverlap least(margin_);
    axes_.separate_capsule(a, b_, least);
    if (least.apart()) return;
    normal = least.normal();
    depth = -least.gap();
  }
  if (a.half > 0) return finder_.meet_capsule(a, b_, normal, depth, found);
  found.normal = normal;
  found.add(a.centre - (a.radius - 0.5 * depth) * normal, depth);
}

void HullContacts::meet_cylinder(const Core& a, ContactPoints& found) {
  LeastOverlap least(margin_);
  axes_.separate_cylinder(a, b_, least);
  if (!least.apart()) finder_.meet_cylinder(a, b_, least, found);
}

/// The hull is in b_, with its centre at the origin.
void HullContacts::meet_hull(const model::Geom& a, const model::BodyPose& pose, ContactPoints& found) {
  const core::Vec3& origin = origin_;
  switch (a.shape) {
    case Shape::sphere:
    case Shape::capsule:
      return meet_round(core_of(a, pose, origin), found);
    case Shape::cylinder:
      return meet_cylinder(core_of(a, pose, origin), found);
    case Shape::plane:
      finder_.lie_on_plane(b_, core::Vec3(pose.position) - origin, axis_z(pose), found);
      found.normal = -found.normal;  // out of the plane, so into b
      return;
    case Shape::box:
    case Shape::hull:
      break;
  }
  a_.place(a, pose, origin);
  LeastOverlap least(margin_);
  axes_.separate(a_, b_, least);
  if (!least.apart()) finder_.meet(a_, b_, least, found);
}

ContactPoints HullContacts::collide(const model::Geom& first, const model::BodyPose& first_pose,
                                    const model::Geom& second, const model::BodyPose& second_pose) {
  ContactPoints found;
  const bool swapped = second.shape != Shape::hull;  // the hull is b
  const model::Geom &a = swapped ? second : first, &b = swapped ? first : second;
  const model::BodyPose &a_pose = swapped ? second_pose : first_pose,
                        &b_pose = swapped ? first_pose : second_pose;
  origin_ = core::Vec3(b_pose.position);
  if (!(origin_ - core::Vec3(a_pose.position)).allFinite()) return found;
  b_.place(b, b_pose, origin_);
  meet_hull(a, a_pose, found);
  if (swapped) found.normal = -found.normal;
  for (ContactPoint& point : found.points) point.position += origin_;
  return found;
}

namespace {

class HullNarrowPhase final : public model::NarrowPhase {
 public:
  HullNarrowPhase(std::unique_ptr<model::NarrowPhase> other, const model::Model& model, double margin_m)
      : other_(std::move(other)), model_(&model), hulls_(margin_m) {}

  void collide(std::span<const model::BodyPose> poses, std::span<const model::GeomPair> pairs,
               std::vector<model::Contact>& contacts) override {
    for (const model::GeomPair& pair : pairs) {
      if (has_hull(geom(pair.first), geom(pair.second)))
        add(pair, poses, contacts);
      else
        other_->collide(poses, {&pair, 1}, contacts);
    }
  }

 private:
  const model::Geom& geom(int index) const { return model_->geoms[static_cast<std::size_t>(index)]; }
  model::BodyPose pose(const model::Geom& one, std::span<const model::BodyPose> poses) const {
    return geom_pose(one,
                     one.body == model::no_body ? static_pose() : poses[static_cast<std::size_t>(one.body)]);
  }

  void add(const model::GeomPair& pair, std::span<const model::BodyPose> poses,
           std::vector<model::Contact>& contacts) {
    const model::Geom &first = geom(pair.first), &second = geom(pair.second);
    const ContactPoints found = hulls_.collide(first, pose(first, poses), second, pose(second, poses));
    for (int i = 0; i < std::min(found.count, model_->contact_law.max_per_pair); ++i)
      contacts.push_back(contact_at(*model_, pair, found.normal, found.points[static_cast<std::size_t>(i)]));
  }

  std::unique_ptr<model::NarrowPhase> other_;
  const model::Model* model_;
  HullContacts hulls_;
};

}  // namespace

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

std::unique_ptr<model::NarrowPhase> with_hulls(std::unique_ptr<model::NarrowPhase> other,
                                               const model::Model& model, double margin_m) {
  const bool any =
      std::ranges::any_of(model.geoms, [](const model::Geom& geom) { return geom.shape == Shape::hull; });
  if (!any) return other;
  return std::make_unique<HullNarrowPhase>(std::move(other), model, margin_m);
}

}  // namespace pbmpi::geometry
