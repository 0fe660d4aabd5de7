#include "bullet/collide/plane_points.h"

#include <cmath>

namespace pbmpi::bullet {
namespace {

/// Turns points of a shape [m], world frame, into contacts with a face: a plane, or a rectangle of it.
class Face {
 public:
  /// `z` is the normal, outward.
  Face(const btVector3& origin, const btVector3& z, btManifoldResult& found)
      : normal_(z), origin_(origin), found_(&found) {}

  /// Restricts the face to the rectangle with these half sides.
  void bound(const btVector3& x, btScalar half_x, const btVector3& y, btScalar half_y) {
    is_bounded_ = true;
    x_ = x;
    y_ = y;
    half_x_ = half_x;
    half_y_ = half_y;
  }
  /// Makes the face that of the first body instead of the second.
  void flip() { is_first_ = true; }

  const btVector3& normal() const { return normal_; }
  void add(const btVector3& point) {
    const btVector3 from = point - origin_;
    if (is_bounded_ && (std::abs(x_.dot(from)) > half_x_ || std::abs(y_.dot(from)) > half_y_)) return;
    const btScalar distance = normal_.dot(from);
    if (is_first_)
      found_->addContactPoint(-normal_, point, distance);
    else
      found_->addContactPoint(normal_, point - distance * normal_, distance);
  }

 private:
  btVector3 normal_, origin_, x_, y_;
  btScalar half_x_ = 0, half_y_ = 0;
  bool is_bounded_ = false, is_first_ = false;
  btManifoldResult* found_;
};

/// Adds four points of a disc's rim: the point nearest to the face, the opposite one, and the two between
/// them.
void add_rim(const btVector3& centre, const btTransform& place, btScalar radius, Face& face) {
  const btVector3 axis = place.getBasis().getColumn(2);
  btVector3 down = -face.normal() + axis * axis.dot(face.normal());
  const bool lies_flat = down.length2() < 1e-12;  // any direction will do
  down = lies_flat ? place.getBasis().getColumn(0) : down.normalized();
  const btVector3 aside = axis.cross(down);
  for (const btVector3& to : {down, -down, aside, -aside}) face.add(centre + radius * to);
}

void add_points(const btCollisionShape& shape, const btTransform& place, Face& face) {
  switch (shape.getShapeType()) {
    case SPHERE_SHAPE_PROXYTYPE: {
      const btScalar radius = static_cast<const btSphereShape&>(shape).getRadius();
      return face.add(place.getOrigin() - radius * face.normal());
    }
    case CAPSULE_SHAPE_PROXYTYPE: {
      const auto& capsule = static_cast<const btCapsuleShape&>(shape);
      for (const btScalar end : {-capsule.getHalfHeight(), capsule.getHalfHeight()})
        face.add(place * btVector3(0, 0, end) - capsule.getRadius() * face.normal());
      return;
    }
    case CYLINDER_SHAPE_PROXYTYPE: {
      const btVector3 half = static_cast<const btCylinderShape&>(shape).getHalfExtentsWithMargin();
      for (const btScalar end : {-half.z(), half.z()})
        add_rim(place * btVector3(0, 0, end), place, half.x(), face);
      return;
    }
    case CONVEX_HULL_SHAPE_PROXYTYPE: {
      const auto& hull = static_cast<const btConvexHullShape&>(shape);
      for (int i = 0; i < hull.getNumPoints(); ++i) face.add(place * hull.getUnscaledPoints()[i]);
      return;
    }
    default: {
      const btVector3 half = static_cast<const btBoxShape&>(shape).getHalfExtentsWithMargin();
      for (int corner = 0; corner < 8; ++corner) {
        face.add(place * btVector3((corner & 1) != 0 ? half.x() : -half.x(),
                                   (corner & 2) != 0 ? half.y() : -half.y(),
                                   (corner & 4) != 0 ? half.z() : -half.z()));
      }
    }
  }
}

bool is_box(const btCollisionObjectWrapper& one) {
  return one.getCollisionShape()->getShapeType() == BOX_SHAPE_PROXYTYPE;
}

/// Cosine of the largest angle to a face's normal at which a round shape lies on the face: 3 degrees.
constexpr btScalar least_cosine = 0.9986;

}  // namespace

void find_plane_points(const btCollisionShape& shape, const btTransform& place, const btTransform& plane,
                       btManifoldResult& found) {
  Face face(plane.getOrigin(), plane.getBasis().getColumn(2), found);
  add_points(shape, place, face);
}

void find_face_points(const btCollisionObjectWrapper& a, const btCollisionObjectWrapper& b,
                      btManifoldResult& found) {
  const btPersistentManifold& manifold = *found.getPersistentManifold();
  const bool box_is_first = is_box(a);
  if (manifold.getNumContacts() == 0 || is_box(a) == is_box(b)) return;
  const btCollisionObjectWrapper &box = is_box(a) ? a : b, &round = is_box(a) ? b : a;
  if (round.getCollisionShape()->getShapeType() == SPHERE_SHAPE_PROXYTYPE) return;
  const btVector3 into_a = manifold.getContactPoint(0).m_normalWorldOnB;
  const btVector3 normal = box_is_first ? -into_a : into_a;  // out of the box
  const btMatrix3x3& turn = box.getWorldTransform().getBasis();
  const btVector3 half = static_cast<const btBoxShape*>(box.getCollisionShape())->getHalfExtentsWithMargin();
  for (int axis = 0; axis < 3; ++axis) {
    const btScalar cosine = turn.getColumn(axis).dot(normal);
    if (std::abs(cosine) < least_cosine) continue;
    const btVector3 outward = cosine > 0 ? turn.getColumn(axis) : -turn.getColumn(axis);
    const int x = (axis + 1) % 3, y = (axis + 2) % 3;
    Face face(box.getWorldTransform().getOrigin() + half[axis] * outward, outward, found);
    face.bound(turn.getColumn(x), half[x], turn.getColumn(y), half[y]);
    if (box_is_first) face.flip();
    add_points(*round.getCollisionShape(), round.getWorldTransform(), face);
  }
}

}  // namespace pbmpi::bullet
