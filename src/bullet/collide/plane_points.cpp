#include "bullet/collide/plane_points.h"

namespace pbmpi::bullet {
namespace {

/// Takes points of a shape [m], world frame, as contacts with a plane.
class PlaneTouch {
 public:
  PlaneTouch(const btTransform& plane, btManifoldResult& found)
      : normal_(plane.getBasis().getColumn(2)), origin_(plane.getOrigin()), found_(&found) {}

  const btVector3& normal() const { return normal_; }
  void add(const btVector3& point) {
    const btScalar distance = normal_.dot(point - origin_);
    found_->addContactPoint(normal_, point - distance * normal_, distance);
  }

 private:
  btVector3 normal_, origin_;
  btManifoldResult* found_;
};

/// Of a disc the point nearest to the plane, that opposite, and the two between.
void add_rim(const btVector3& centre, const btTransform& place, btScalar radius, PlaneTouch& touch) {
  const btVector3 axis = place.getBasis().getColumn(2);
  btVector3 down = -touch.normal() + axis * axis.dot(touch.normal());
  const bool lies_flat = down.length2() < 1e-12;  // any direction will do
  down = lies_flat ? place.getBasis().getColumn(0) : down.normalized();
  const btVector3 aside = axis.cross(down);
  for (const btVector3& to : {down, -down, aside, -aside}) touch.add(centre + radius * to);
}

}  // namespace

void find_plane_points(const btCollisionShape& shape, const btTransform& place, const btTransform& plane,
                       btManifoldResult& found) {
  PlaneTouch touch(plane, found);
  switch (shape.getShapeType()) {
    case SPHERE_SHAPE_PROXYTYPE: {
      const btScalar radius = static_cast<const btSphereShape&>(shape).getRadius();
      return touch.add(place.getOrigin() - radius * touch.normal());
    }
    case CAPSULE_SHAPE_PROXYTYPE: {
      const auto& capsule = static_cast<const btCapsuleShape&>(shape);
      for (const btScalar end : {-capsule.getHalfHeight(), capsule.getHalfHeight()})
        touch.add(place * btVector3(0, 0, end) - capsule.getRadius() * touch.normal());
      return;
    }
    case CYLINDER_SHAPE_PROXYTYPE: {
      const btVector3 half = static_cast<const btCylinderShape&>(shape).getHalfExtentsWithMargin();
      for (const btScalar end : {-half.z(), half.z()})
        add_rim(place * btVector3(0, 0, end), place, half.x(), touch);
      return;
    }
    default: {
      const btVector3 half = static_cast<const btBoxShape&>(shape).getHalfExtentsWithMargin();
      for (int corner = 0; corner < 8; ++corner) {
        touch.add(place * btVector3((corner & 1) != 0 ? half.x() : -half.x(),
                                    (corner & 2) != 0 ? half.y() : -half.y(),
                                    (corner & 4) != 0 ? half.z() : -half.z()));
      }
    }
  }
}

}  // namespace pbmpi::bullet
