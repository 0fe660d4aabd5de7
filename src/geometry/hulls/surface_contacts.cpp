#include "geometry/hulls/surface_contacts.h"

#include <algorithm>
#include <utility>

#include "geometry/geometry.h"

namespace pbmpi::geometry {
namespace {

using core::Vec3;
using RowMajor = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

/// Sine of the angle by which rounding may lean a normal over an edge.
constexpr double level = 1e-7;

/// Does the normal lean over no edge of the triangle farther than the surface goes on there?
bool is_own(const TriangleMesh::Edges& edges, const Vec3& normal_in_mesh) {
  return std::ranges::all_of(edges.beyond,
                             [&](const Vec3& beyond) { return normal_in_mesh.dot(beyond) <= level; });
}

/// The box about a geom in the mesh's frame.
Box box_in(const model::Geom& geom, const core::Mat3& turn, const Vec3& centre, double margin_m) {
  const RowMajor rows = turn;
  const std::array<double, 3> half = half_extents(geom, rows.data());
  Box box;
  for (int k = 0; k < 3; ++k) {
    const auto at = static_cast<std::size_t>(k);
    box.min[at] = centre[k] - half[at];
    box.max[at] = centre[k] + half[at];
  }
  constexpr double rounding = 1e-6;  // of the coordinates
  return box.grown(margin_m + rounding * centre.cwiseAbs().maxCoeff());
}

}  // namespace

void SurfaceContacts::find_near(const model::Geom& a, const model::BodyPose& pose, const TriangleMesh& mesh,
                                const model::BodyPose& mesh_pose) {
  const core::Mat3 axes = Eigen::Map<const RowMajor>(pose.rotation);
  const Vec3 centre = to_mesh_ * (Vec3(pose.position) - Vec3(mesh_pose.position));
  near_.clear();
  mesh.tree.for_each_near(box_in(a, to_mesh_ * axes, centre, margin_),
                          [&](int triangle) { near_.push_back(triangle); });
  std::ranges::sort(near_);
}

/// A geom whose centre is farther below the triangle than it is large is on the other side of the surface.
void SurfaceContacts::meet_triangle(const model::Geom& a, const model::BodyPose& pose,
                                    const TriangleMesh& mesh, int triangle,
                                    const model::BodyPose& mesh_pose) {
  const Vec3 origin(pose.position);
  triangle_.place_triangle(mesh, triangle, mesh_pose, origin);
  const Vec3& normal = triangle_.normal(0);
  const double below = triangle_.height(0);  // of the geom's centre, which is the origin
  if (below > size_ || -half_extent(a, pose.rotation, -normal) - below > margin_) return;
  ContactPoints touching;
  hulls_.meet(a, pose, origin, triangle_, touching);
  const bool stands = touching.count > 0 &&
                      is_own(mesh.edges[static_cast<std::size_t>(triangle)], to_mesh_ * touching.normal);
  if (!stands) {
    touching.count = 0;
    hulls_.lie_on(a, pose, origin, triangle_, touching);
  }
  for (int i = 0; i < touching.count; ++i) {
    ContactPoint point = touching.points[static_cast<std::size_t>(i)];
    all_.push_back({touching.normal, {point.position + origin, point.depth}});
  }
}

/// Points of neighbouring triangles may be one point.
void SurfaceContacts::choose(const Vec3& normal) {
  constexpr double same_place = 1e-6;  // of the size
  constexpr std::size_t few = 16;      // more have four that are apart
  Vec3 middle = Vec3::Zero();
  if (patch_.size() <= few) {
    std::size_t kept = 0;
    for (const SurfacePoint& point : patch_) {
      const auto end = patch_.begin() + static_cast<std::ptrdiff_t>(kept);
      const bool is_new = std::none_of(patch_.begin(), end, [&](const SurfacePoint& one) {
        return (one.at.position - point.at.position).norm() <= same_place * size_ &&
               (one.normal - point.normal).norm() <= same_place;
      });
      if (is_new) patch_[kept++] = point;
    }
    patch_.resize(kept);
  }
  patch_points_.clear();
  for (const SurfacePoint& point : patch_) {
    patch_points_.push_back(point.at);
    middle += point.at.position / static_cast<double>(patch_.size());
  }
  // Of points that are about equally deep the outermost comes first: on a level surface that is a corner.
  constexpr double as_depth = 1e-3;
  std::size_t first = 0;
  double most = -model::infinity;
  for (std::size_t i = 0; i < patch_points_.size(); ++i) {
    const ContactPoint& point = patch_points_[i];
    const double rated = point.depth + as_depth * (point.position - middle).norm();
    if (!(rated > most)) continue;
    most = rated;
    first = i;
  }
  const Chosen chosen = spread(patch_points_, first, normal);
  for (int i = 0; i < std::min(chosen.count, most_); ++i)
    found_.push_back(patch_[chosen.index[static_cast<std::size_t>(i)]]);
}

/// Each patch is about the normal of the deepest point that is left.
void SurfaceContacts::choose_patches() {
  constexpr double least_cosine = 0.97;  // 14 degrees
  for (std::size_t i = 0; i < most_patches && !all_.empty(); ++i) {
    const Vec3 normal =
        std::ranges::max_element(all_, {}, [](const SurfacePoint& one) { return one.at.depth; })->normal;
    const auto rest = std::stable_partition(all_.begin(), all_.end(), [&](const SurfacePoint& one) {
      return one.normal.dot(normal) < least_cosine;
    });
    patch_.assign(rest, all_.end());
    all_.erase(rest, all_.end());
    choose(normal);
  }
}

void SurfaceContacts::meet_mesh(const model::Geom& a, const model::BodyPose& pose, const model::Geom& mesh,
                                const model::BodyPose& mesh_pose) {
  if (!(Vec3(pose.position) - Vec3(mesh_pose.position)).allFinite()) return;
  size_ = bounding_radius(a);
  to_mesh_ = Eigen::Map<const RowMajor>(mesh_pose.rotation).transpose();
  find_near(a, pose, *mesh.mesh, mesh_pose);
  all_.clear();
  for (const int triangle : near_) meet_triangle(a, pose, *mesh.mesh, triangle, mesh_pose);
  choose_patches();
}

std::span<const SurfacePoint> SurfaceContacts::collide(const model::Geom& first,
                                                       const model::BodyPose& first_pose,
                                                       const model::Geom& second,
                                                       const model::BodyPose& second_pose) {
  found_.clear();
  if (second.shape == model::Shape::mesh) {
    meet_mesh(first, first_pose, second, second_pose);
  } else if (first.shape == model::Shape::mesh) {
    meet_mesh(second, second_pose, first, first_pose);
    for (SurfacePoint& point : found_) point.normal = -point.normal;
  } else {
    const ContactPoints points = hulls_.collide(first, first_pose, second, second_pose);
    for (int i = 0; i < std::min(points.count, most_); ++i)
      found_.push_back({points.normal, points.points[static_cast<std::size_t>(i)]});
  }
  return found_;
}

namespace {

class SurfaceNarrowPhase final : public model::NarrowPhase {
 public:
  SurfaceNarrowPhase(std::unique_ptr<model::NarrowPhase> other, const model::Model& model, double margin_m)
      : other_(std::move(other)), model_(&model), surfaces_(margin_m, model.contact_law.max_per_pair) {}

  void collide(std::span<const model::BodyPose> poses, std::span<const model::GeomPair> pairs,
               std::vector<model::Contact>& contacts) override {
    for (const model::GeomPair& pair : pairs) {
      if (has_surface(geom(pair.first), geom(pair.second)))
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
    for (const SurfacePoint& found :
         surfaces_.collide(first, pose(first, poses), second, pose(second, poses)))
      contacts.push_back(contact_at(*model_, pair, found.normal, found.at));
  }

  std::unique_ptr<model::NarrowPhase> other_;
  const model::Model* model_;
  SurfaceContacts surfaces_;
};

}  // namespace

std::unique_ptr<model::NarrowPhase> with_surfaces(std::unique_ptr<model::NarrowPhase> other,
                                                  const model::Model& model, double margin_m) {
  const bool any =
      std::ranges::any_of(model.geoms, [](const model::Geom& geom) { return geom.hull != nullptr; });
  if (!any) return other;
  return std::make_unique<SurfaceNarrowPhase>(std::move(other), model, margin_m);
}

}  // namespace pbmpi::geometry
