#include "bullet/objects/shapes.h"

#include <stdexcept>

#include "core/error.h"

namespace pbmpi::bullet {
namespace {

std::unique_ptr<btCollisionShape> make_hull(const model::Hull& hull) {
  auto shape = std::make_unique<btConvexHullShape>();
  shape->setMargin(0);  // the default would widen the hull by 4 cm
  for (const model::Vec3& vertex : hull.vertices)
    shape->addPoint(btVector3(vertex.x(), vertex.y(), vertex.z()), false);
  shape->recalcLocalAabb();
  return shape;
}

std::unique_ptr<btCollisionShape> make_shape(const model::Geom& geom) {
  const auto& [a, b, c] = geom.size;
  switch (geom.shape) {
    case model::Shape::sphere:
      return std::make_unique<btSphereShape>(a);
    case model::Shape::box:
      return std::make_unique<btBoxShape>(btVector3(a / 2, b / 2, c / 2));
    case model::Shape::capsule:
      return std::make_unique<btCapsuleShapeZ>(a, b);
    case model::Shape::cylinder:
      return std::make_unique<btCylinderShapeZ>(btVector3(a, a, b / 2));
    case model::Shape::plane:
      return std::make_unique<btStaticPlaneShape>(btVector3(0, 0, 1), 0);
    case model::Shape::hull:
      return make_hull(*geom.hull);
    case model::Shape::mesh:
      throw core::InputError(
          "bullet: a mesh of triangles or a height field is not there with Bullet; use another stepper, or "
          "change the scene");
  }
  throw std::logic_error("bullet: a geom without a shape");
}

}  // namespace

Shapes::Shapes(const model::Model& model, Bodies& bodies) : model_(&model), bodies_(&bodies) {
  for (const model::Geom& geom : model.geoms) {
    shapes_.push_back(make_shape(geom));
    local_.push_back(bodies.local(geom.body, to_bullet(geom.local)));
    // As in btCollisionDispatcher with CD_USE_RELATIVE_CONTACT_BREAKING_THRESHOLD, its default.
    reach_.push_back(shapes_.back()->getContactBreakingThreshold(gContactBreakingThreshold));
  }
  placed_ = local_;
  move();
}

void Shapes::move() {
  for (std::size_t geom = 0; geom < shapes_.size(); ++geom) {
    const int body = model_->geoms[geom].body;
    if (body != model::no_body) placed_[geom] = (*bodies_)[body].getCenterOfMassTransform() * local_[geom];
  }
}

btRigidBody& Shapes::body(int geom) const {
  return bodies_->get(model_->geoms[static_cast<std::size_t>(geom)].body);
}

}  // namespace pbmpi::bullet
