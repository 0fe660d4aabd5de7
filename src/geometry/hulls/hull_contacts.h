/// Contacts of hulls with all shapes.
#pragma once

#include <memory>

#include "geometry/hulls/contact_points.h"
#include "model/contact.h"

namespace pbmpi::geometry {

/// Collides pairs of geoms of which one is a hull, in plain double precision, so that the bits are the same
/// whatever the rest is computed with. Faces, edges and corners against each other by the axis of least
/// overlap, with the points of boxes; balls and capsules by the nearest points of their middle, as long as
/// that is outside.
class HullContacts {
 public:
  /// `margin` [m]: finds contacts between geoms up to this far apart, with negative depths.
  explicit HullContacts(double margin_m) : margin_(margin_m), finder_(margin_m) {}

  /// The poses are the geoms' own (geom_pose()). The normal of the points found points into `first`, and
  /// their positions are in the world frame.
  /// Nothing if a pose is not finite.
  ContactPoints collide(const model::Geom& first, const model::BodyPose& first_pose,
                        const model::Geom& second, const model::BodyPose& second_pose);

 private:
  void meet_hull(const model::Geom& a, const model::BodyPose& pose, ContactPoints& found);
  void meet_round(const Core& a, ContactPoints& found);
  void meet_cylinder(const Core& a, ContactPoints& found);

  double margin_;
  core::Vec3 origin_ = core::Vec3::Zero();  ///< [m] of the pair, world frame
  Polyhedron a_, b_;
  HullAxes axes_;
  ContactFinder finder_;
};

inline bool has_hull(const model::Geom& first, const model::Geom& second) {
  return first.shape == model::Shape::hull || second.shape == model::Shape::hull;
}

/// A point that was found for a pair, with the normal into its first geom, as a contact: body a is a real
/// one.
model::Contact contact_at(const model::Model& model, const model::GeomPair& pair, const core::Vec3& normal,
                          const ContactPoint& point);

/// `other`, with HullContacts for the pairs that have a hull. `model` is borrowed.
std::unique_ptr<model::NarrowPhase> with_hulls(std::unique_ptr<model::NarrowPhase> other,
                                               const model::Model& model, double margin_m);

}  // namespace pbmpi::geometry
