#include "geometry/seams.h"

#include <algorithm>
#include <cmath>

#include "geometry/face_contact.h"
#include "geometry/touching_solids.h"

namespace pbmpi::geometry {
namespace {

constexpr double most_tolerance_m = 1e-4;
constexpr double most_share_of_thickness = 1e-3;
/// [m] How far a query may look from the point for which it asks the tree.
constexpr double reach_m = 4 * most_tolerance_m;

double tolerance_of(const model::Geom& geom) {
  return std::min(most_tolerance_m, most_share_of_thickness * 2 * least_half_extent(geom));
}

Box box_about(const Solid& solid) {
  Box box;
  for (int k = 0; k < 3; ++k) {
    const double half = solid.half_along(core::Vec3::Unit(k));
    box.min[static_cast<std::size_t>(k)] = solid.centre[k] - half - reach_m;
    box.max[static_cast<std::size_t>(k)] = solid.centre[k] + half + reach_m;
  }
  return box;
}

Box box_at(const core::Vec3& point) {
  Box box;
  for (std::size_t k = 0; k < 3; ++k) box.min[k] = box.max[k] = point[static_cast<int>(k)];
  return box;
}

/// Two directions along a face, and how far it reaches from its middle in each: of a disc the square within
/// it.
struct FaceExtent {
  core::Vec3 middle, along[2];
  double half[2];

  FaceExtent(const Solid& solid, const Face& face) {
    constexpr double half_of_square = 0.70710678118654752440;  // in a disc of radius 1
    middle = solid.centre + solid.extent.half[static_cast<std::size_t>(face.axis)] * normal_of(solid, face);
    for (int k = 0; k < 2; ++k) {
      const int axis = (face.axis + 1 + k) % 3;
      along[k] = solid.axes.col(axis);
      half[k] = solid.extent.half[static_cast<std::size_t>(axis)] + half_of_square * solid.extent.disc;
    }
  }
  bool holds(const core::Vec3& point, double border) const {
    const core::Vec3 from = point - middle;
    return std::abs(along[0].dot(from)) <= half[0] - border &&
           std::abs(along[1].dot(from)) <= half[1] - border;
  }
};

}  // namespace

/// A body's frame in the world's.
struct Seams::Frame {
  core::Vec3 origin;
  core::Mat3 rotation;

  explicit Frame(const model::BodyPose& body)
      : origin(body.position),
        rotation(Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(body.rotation)) {}
  core::Vec3 point_in(const core::Vec3& point) const { return rotation.transpose() * (point - origin); }
  core::Vec3 direction_in(const core::Vec3& direction) const { return rotation.transpose() * direction; }
  core::Vec3 point_out(const core::Vec3& point) const { return origin + rotation * point; }
  core::Vec3 direction_out(const core::Vec3& direction) const { return rotation * direction; }
};

/// A geom, and in the frame of its body what touches it.
struct Seams::Touched {
  int geom = 0;
  Frame frame;
  Solid other;
  double outward = 1;  ///< 1 if the contacts' normals point out of the geom, else -1
  std::span<const model::Contact> contacts;
};

std::unique_ptr<const Seams> Seams::find(const model::Model& model) {
  std::unique_ptr<const Seams> seams(new Seams(model));
  const bool any_touch =
      std::any_of(seams->parts_.begin(), seams->parts_.end(), [](const Part& part) { return part.touches; });
  return any_touch ? std::move(seams) : nullptr;
}

Seams::Seams(const model::Model& model)
    : model_(&model), parts_(model.geoms.size()), is_even_(model.bodies.size(), 0) {
  add_parts();
  for (int geom = 0; geom < static_cast<int>(parts_.size()); ++geom) find_neighbours(geom);
  leave_out_uneven_bodies();
}

void Seams::add_parts() {
  std::vector<int> geoms_of(model_->bodies.size(), 0);
  for (const model::Geom& geom : model_->geoms) {
    if (geom.body != model::no_body) ++geoms_of[static_cast<std::size_t>(geom.body)];
  }
  constexpr int static_cluster = 0;
  int num_clusters = 1;
  std::vector<int> cluster_of(model_->bodies.size());
  for (std::size_t body = 0; body < geoms_of.size(); ++body)
    cluster_of[body] = geoms_of[body] > 1 ? num_clusters++ : -1;
  clusters_.resize(static_cast<std::size_t>(num_clusters));
  for (int i = 0; i < static_cast<int>(parts_.size()); ++i) {
    const model::Geom& geom = model_->geoms[static_cast<std::size_t>(i)];
    const int cluster =
        geom.body == model::no_body ? static_cluster : cluster_of[static_cast<std::size_t>(geom.body)];
    if (cluster < 0 || geom.shape == model::Shape::hull || geom.shape == model::Shape::mesh) continue;
    Part& part = parts_[static_cast<std::size_t>(i)];
    part.solid = solid_at(geom, geom_pose(geom, static_pose()));
    part.tolerance_m = tolerance_of(geom);
    geom.shape == model::Shape::plane ? planes_.push_back(i) : add_to_cluster(cluster, i);
  }
  for (Cluster& cluster : clusters_) cluster.tree.set(cluster.boxes);
}

void Seams::add_to_cluster(int cluster, int geom) {
  Part& part = parts_[static_cast<std::size_t>(geom)];
  part.cluster = cluster;
  clusters_[static_cast<std::size_t>(cluster)].geoms.push_back(geom);
  clusters_[static_cast<std::size_t>(cluster)].boxes.push_back(box_about(part.solid));
}

void Seams::find_neighbours(int geom) {
  const Part& part = parts_[static_cast<std::size_t>(geom)];
  if (part.cluster < 0) return;
  const Cluster& cluster = clusters_[static_cast<std::size_t>(part.cluster)];
  cluster.tree.for_each_near(box_about(part.solid),
                             [&](int item) { meet(geom, cluster.geoms[static_cast<std::size_t>(item)]); });
  if (group_of(geom) != model::no_body) return;
  for (const int plane : planes_) meet(geom, plane);
}

void Seams::meet(int first, int second) {
  Part &one = parts_[static_cast<std::size_t>(first)], &other = parts_[static_cast<std::size_t>(second)];
  const double tolerance = std::min(one.tolerance_m, other.tolerance_m);
  if (first == second || are_apart(one.solid, other.solid, tolerance)) return;
  add_coverable(one, other);
  add_coverable(other, one);
  const int body = group_of(first);
  if (body != model::no_body && are_flush(one.solid, other.solid, tolerance))
    is_even_[static_cast<std::size_t>(body)] = 1;
}

void Seams::leave_out_uneven_bodies() {
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    const int body = model_->geoms[i].body;
    if (body != model::no_body && is_even_[static_cast<std::size_t>(body)] == 0) parts_[i].touches = false;
  }
}

void Seams::add_coverable(Part& part, const Part& neighbour) {
  if (part.solid.shape == model::Shape::plane) return;
  part.touches = true;
  const double tolerance = std::min(part.tolerance_m, neighbour.tolerance_m);
  for (const Face& face : faces_of(part.solid)) {
    if (reaches_over(part.solid, face, neighbour.solid, tolerance))
      part.coverable |= 1u << index_of(part.solid, face);
  }
}

/// Calls found(part, tolerance) for parts that may be at the point, until it returns true.
template <class Found>
bool Seams::any_neighbour(int geom, const core::Vec3& point, const Found& found) const {
  const double tolerance = parts_[static_cast<std::size_t>(geom)].tolerance_m;
  const auto look_at = [&](int other) {
    if (other == geom) return false;
    const Part& part = parts_[static_cast<std::size_t>(other)];
    return found(part.solid, std::min(tolerance, part.tolerance_m));
  };
  if (const int index = parts_[static_cast<std::size_t>(geom)].cluster; index >= 0) {
    const Cluster& cluster = clusters_[static_cast<std::size_t>(index)];
    const auto look_at_item = [&](int item) {
      return look_at(cluster.geoms[static_cast<std::size_t>(item)]);
    };
    if (cluster.tree.any_near(box_at(point), look_at_item)) return true;
  }
  return group_of(geom) == model::no_body && std::any_of(planes_.begin(), planes_.end(), look_at);
}

bool Seams::is_covered(int geom, const core::Vec3& point, const core::Vec3& normal) const {
  return touches(geom) && any_neighbour(geom, point, [&](const Solid& neighbour, double tolerance) {
           return normals_at(neighbour, point + 2 * tolerance * normal, tolerance).has_value();
         });
}

bool Seams::covers(int geom, const model::BodyPose& body, const core::Vec3& point,
                   const core::Vec3& normal) const {
  const Frame frame(body);
  return is_covered(geom, frame.point_in(point), frame.direction_in(normal));
}

bool Seams::is_allowed(int geom, const core::Vec3& point, const core::Vec3& normal) const {
  return !any_neighbour(geom, point, [&](const Solid& neighbour, double tolerance) {
    const auto normals = normals_at(neighbour, point, tolerance);
    return normals && !normals->holds(normal);
  });
}

bool Seams::is_on_open_face(int geom, const Face& face, const core::Vec3& point) const {
  const Part& part = parts_[static_cast<std::size_t>(geom)];
  return FaceExtent(part.solid, face).holds(point, part.tolerance_m) &&
         !is_covered(geom, point, normal_of(part.solid, face));
}

/// Is some part of the face under the other solid open? Nine points of the rectangle about that part are
/// tried.
bool Seams::is_open(int geom, const Face& face, const Solid& other) const {
  const Part& part = parts_[static_cast<std::size_t>(geom)];
  if (!part.may_be_covered(face)) return true;
  const FaceExtent extent(part.solid, face);
  double low[2], high[2];
  for (int k = 0; k < 2; ++k) {
    const double at = extent.along[k].dot(other.centre - extent.middle);
    const double border = extent.half[k] - part.tolerance_m;
    low[k] = std::max(at - other.half_along(-extent.along[k]), -border);
    high[k] = std::min(at + other.half_along(extent.along[k]), border);
    if (!(low[k] <= high[k])) return false;
  }
  const auto place = [&](int k, double share) {
    return core::Vec3((low[k] + share * (high[k] - low[k])) * extent.along[k]);
  };
  for (const double first : {0.5, 0.0, 1.0}) {
    for (const double second : {0.5, 0.0, 1.0}) {
      if (!is_covered(geom, extent.middle + place(0, first) + place(1, second), normal_of(part.solid, face)))
        return true;
    }
  }
  return false;
}

bool Seams::any_stands(const Touched& touched) const {
  const Part& part = parts_[static_cast<std::size_t>(touched.geom)];
  std::optional<Face> face;
  for (const model::Contact& contact : touched.contacts) {
    const core::Vec3 normal = touched.outward * touched.frame.direction_in(contact.normal);
    const Support at = support_at(part.solid, normal, touched.frame.point_in(contact.position));
    switch (at.kind) {
      case Support::Kind::face:
        if (!part.may_be_covered(at.face)) return true;
        if (is_on_open_face(touched.geom, at.face, at.point)) return true;
        face = at.face;
        break;
      case Support::Kind::round:
        if (!is_covered(touched.geom, at.point, normal)) return true;
        break;
      case Support::Kind::edge:
        if (is_allowed(touched.geom, at.point, normal)) return true;
        break;
    }
  }
  return face && is_open(touched.geom, *face, touched.other);
}

void Seams::correct(const Side& own, const Side& other, std::size_t first, double least_depth,
                    std::vector<model::Contact>& contacts) const {
  const auto geom_of = [&](const Side& side) -> const model::Geom& {
    return model_->geoms[static_cast<std::size_t>(side.geom)];
  };
  // A plane has the same normal everywhere, and a mesh has corrected its own: no edge of the other geom can
  // turn them.
  const model::Shape shape = geom_of(other).shape;
  const bool keeps_normals = shape == model::Shape::plane || shape == model::Shape::mesh;
  if (first == contacts.size() || !touches(own.geom) || keeps_normals) return;
  const Frame frame(own.body);
  Solid solid = solid_at(geom_of(other), geom_pose(geom_of(other), other.body));
  solid.centre = frame.point_in(solid.centre);
  solid.axes = frame.rotation.transpose() * solid.axes;
  const double outward = contacts[first].body_a == geom_of(own).body ? -1 : 1;
  const Touched touched{own.geom, frame, solid, outward, std::span(contacts).subspan(first)};
  if (any_stands(touched)) return;
  const model::Contact like = contacts[first];
  contacts.resize(first);
  replace(touched, least_depth, like, contacts);
}

/// The other geom leaves through the open face that it overlaps least. One that would have to move by more
/// than its own size is buried, and its way out is another geom's affair.
void Seams::replace(const Touched& touched, double least_depth, const model::Contact& like,
                    std::vector<model::Contact>& contacts) const {
  const Solid& solid = parts_[static_cast<std::size_t>(touched.geom)].solid;
  std::optional<Face> nearest;
  double least = model::infinity;
  for (const Face& face : faces_of(solid)) {
    const core::Vec3 normal = normal_of(solid, face);
    const double half = touched.other.half_along(-normal);
    const double overlap = solid.half_along(normal) + half - normal.dot(touched.other.centre - solid.centre);
    if (!(overlap < least && overlap <= 2 * half) || !is_open(touched.geom, face, touched.other)) continue;
    least = overlap;
    nearest = face;
  }
  if (!nearest) return;
  model::Contact contact = like;
  contact.normal = touched.outward * touched.frame.direction_out(normal_of(solid, *nearest));
  int room = model_->contact_law.max_per_pair;
  for (const FacePoint& point : lie_on_face(touched.other, solid, *nearest, least_depth)) {
    if (room-- == 0) break;
    contact.position = touched.frame.point_out(point.position);
    contact.depth = point.depth;
    contacts.push_back(contact);
  }
}

}  // namespace pbmpi::geometry
