/// World-aligned boxes about geoms and about whole spaces.
#pragma once

#include <algorithm>
#include <array>

#include "model/contact.h"
#include "model/model.h"

namespace pbmpi::geometry {

/// Corners [m], world frame. A new box is empty: no box overlaps it.
struct Box {
  std::array<double, 3> min{model::infinity, model::infinity, model::infinity};
  std::array<double, 3> max{-model::infinity, -model::infinity, -model::infinity};

  void include(const Box& other) {
    for (std::size_t k = 0; k < 3; ++k) {
      min[k] = std::min(min[k], other.min[k]);
      max[k] = std::max(max[k], other.max[k]);
    }
  }
  /// The box enlarged by this length on every side.
  Box grown(double length) const {
    Box larger = *this;
    for (std::size_t k = 0; k < 3; ++k) {
      larger.min[k] -= length;
      larger.max[k] += length;
    }
    return larger;
  }
  /// Is all of the other box within this one? Not if any number is a NaN.
  bool holds(const Box& other) const {
    return min[0] <= other.min[0] && other.max[0] <= max[0] && min[1] <= other.min[1] &&
           other.max[1] <= max[1] && min[2] <= other.min[2] && other.max[2] <= max[2];
  }
  /// Touching counts.
  bool overlaps(const Box& other) const {
    return min[0] <= other.max[0] && other.min[0] <= max[0] && min[1] <= other.max[1] &&
           other.min[1] <= max[1] && min[2] <= other.max[2] && other.min[2] <= max[2];
  }
};

/// A box about the geom's centre that holds it, from its body's pose. Not for planes. It is larger than
/// needed by some 1e-6 of the coordinates: boxes must not separate geoms that a collider in single precision
/// finds touching.
Box geom_box(const model::Geom& geom, const model::BodyPose& body);
/// The same from the geom's own pose.
Box box_at(const model::Geom& geom, const model::BodyPose& pose);

/// The box around a ball swept along its path. It is larger than needed by 1e-6 of its coordinates, so that
/// rounding in later computations within it does not matter.
Box swept_box(const core::Vec3& centre, double radius, const core::Vec3& way);

}  // namespace pbmpi::geometry
