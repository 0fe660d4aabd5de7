/// Geoms as Bullet's shapes.
#pragma once

#include <memory>
#include <vector>

#include "bullet/objects/bodies.h"

namespace pbmpi::bullet {

/// One shape per geom, in the model's order, each with its pose in a step.
class Shapes {
 public:
  /// `model` and `bodies` are borrowed.
  Shapes(const model::Model& model, Bodies& bodies);

  /// Moves the shapes to the poses of their bodies.
  void move();

  int size() const { return static_cast<int>(shapes_.size()); }
  const btCollisionShape& shape(int geom) const { return *shapes_[static_cast<std::size_t>(geom)]; }
  const btTransform& place(int geom) const { return placed_[static_cast<std::size_t>(geom)]; }  ///< world
  btRigidBody& body(int geom) const;
  /// [m] Largest distance at which this shape has contacts; a pair takes the smaller of its two values.
  double reach(int geom) const { return reach_[static_cast<std::size_t>(geom)]; }

 private:
  const model::Model* model_;
  Bodies* bodies_;
  std::vector<std::unique_ptr<btCollisionShape>> shapes_;
  std::vector<btTransform> local_;   ///< [geoms] in the frame of Bullet's body
  std::vector<btTransform> placed_;  ///< [geoms]
  std::vector<double> reach_;        ///< [geoms]
};

}  // namespace pbmpi::bullet
