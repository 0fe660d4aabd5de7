/// Contacts of hulls with all shapes but meshes.
#pragma once

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

  /// Where a geom touches a polyhedron; positions about `origin` [m], world frame. Nothing where the
  /// polyhedron is a triangle, and what touches is beside it.
  void meet(const model::Geom& a, const model::BodyPose& pose, const core::Vec3& origin, const Polyhedron& b,
            ContactPoints& found);
  /// What of a geom is over face 0 of a polyhedron, with that face's normal.
  void lie_on(const model::Geom& a, const model::BodyPose& pose, const core::Vec3& origin,
              const Polyhedron& b, ContactPoints& found);

 private:
  void meet_round(const Core& a, const Polyhedron& b, ContactPoints& found);
  void meet_cylinder(const Core& a, const Polyhedron& b, ContactPoints& found);

  double margin_;
  Polyhedron a_, b_;
  HullAxes axes_;
  ContactFinder finder_;
};

/// A point that was found for a pair, with the normal into its first geom, as a contact: body a is a real
/// one.
model::Contact contact_at(const model::Model& model, const model::GeomPair& pair, const core::Vec3& normal,
                          const ContactPoint& point);

}  // namespace pbmpi::geometry
