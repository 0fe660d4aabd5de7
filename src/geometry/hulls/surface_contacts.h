/// Contacts of the shapes that are given by points: hulls and meshes.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "geometry/hulls/hull_contacts.h"

namespace pbmpi::geometry {

struct SurfacePoint {
  core::Vec3 normal = core::Vec3::UnitZ();  ///< unit, into the first geom
  ContactPoint at;                          ///< world frame
};

/// A geom touches a mesh triangle by triangle, each of which stands for the solid below it: a hull of one
/// face. No inner edge may catch what moves along: a normal that leans over an edge farther than the next
/// triangle's is turned to the triangle's own, as in Bullet (btInternalEdgeUtility) and Box2D (ghost
/// vertices), and only what is over the triangle then counts. Points whose normals differ little make a
/// patch, of which those that spread most stay.
class SurfaceContacts {
 public:
  /// `margin` [m]: as of HullContacts. `most`: points of a hull, and of each patch on a mesh.
  SurfaceContacts(double margin_m, int most) : margin_(margin_m), most_(most), hulls_(margin_m) {}

  /// A pair of which one geom is a hull or a mesh; poses as for HullContacts::collide(). The points stay
  /// until the next call; those of a patch follow each other.
  std::span<const SurfacePoint> collide(const model::Geom& first, const model::BodyPose& first_pose,
                                        const model::Geom& second, const model::BodyPose& second_pose);

 private:
  static constexpr std::size_t most_patches = 4;

  void meet_mesh(const model::Geom& a, const model::BodyPose& pose, const model::Geom& mesh,
                 const model::BodyPose& mesh_pose);
  void find_near(const model::Geom& a, const model::BodyPose& pose, const TriangleMesh& mesh,
                 const model::BodyPose& mesh_pose);
  void meet_triangle(const model::Geom& a, const model::BodyPose& pose, const TriangleMesh& mesh,
                     int triangle, const model::BodyPose& mesh_pose);
  void choose_patches();
  void choose(const core::Vec3& normal);

  double margin_;
  int most_;
  double size_ = 0;     ///< [m] radius of the ball about the geom's centre that holds it
  core::Mat3 to_mesh_;  ///< from the world's axes to the mesh's
  HullContacts hulls_;
  Polyhedron triangle_;
  std::vector<int> near_;
  std::vector<SurfacePoint> all_, patch_, found_;
  std::vector<ContactPoint> patch_points_;
};

inline bool has_surface(const model::Geom& first, const model::Geom& second) {
  const auto has_one = [](const model::Geom& geom) { return geom.hull != nullptr; };
  return has_one(first) || has_one(second);
}

/// `other`, with SurfaceContacts for the pairs that have a hull or a mesh. `model` is borrowed.
std::unique_ptr<model::NarrowPhase> with_surfaces(std::unique_ptr<model::NarrowPhase> other,
                                                  const model::Model& model, double margin_m);

}  // namespace pbmpi::geometry
