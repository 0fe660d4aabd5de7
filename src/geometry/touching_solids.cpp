#include "geometry/touching_solids.h"

#include <cmath>

namespace pbmpi::geometry {
namespace {

/// Do the axes of one of them show that they are farther apart than the tolerance?
bool apart_along_own_axes(const Solid& one, const Solid& other, double tolerance) {
  const core::Vec3 apart = other.centre - one.centre;
  for (int k = 0; k < 3; ++k) {
    const core::Vec3 axis = one.axes.col(k);
    if (std::abs(apart.dot(axis)) > one.half_along(axis) + other.half_along(axis) + tolerance) return true;
  }
  return false;
}

}  // namespace

bool are_apart(const Solid& solid, const Solid& other, double tolerance) {
  if (other.shape == model::Shape::plane) {
    const core::Vec3 normal = other.axes.col(2);
    return normal.dot(solid.centre - other.centre) > solid.half_along(normal) + tolerance;
  }
  return apart_along_own_axes(solid, other, tolerance) || apart_along_own_axes(other, solid, tolerance);
}

bool reaches_over(const Solid& solid, const Face& face, const Solid& other, double tolerance) {
  const core::Vec3 normal = normal_of(solid, face);
  const core::Vec3 middle = solid.centre + solid.extent.half[static_cast<std::size_t>(face.axis)] * normal;
  if (other.shape != model::Shape::plane)
    return normal.dot(other.centre - middle) + other.half_along(normal) > tolerance;
  const core::Vec3 up = other.axes.col(2);
  const core::Vec3 in_front = middle + 2 * tolerance * normal;
  const double half_of_face =
      solid.half_along(up) -
      std::abs(up.dot(normal)) * solid.extent.half[static_cast<std::size_t>(face.axis)];
  return up.dot(in_front - other.centre) - half_of_face < -tolerance;
}

bool are_flush(const Solid& one, const Solid& other, double tolerance) {
  for (const Face& face : faces_of(one)) {
    const core::Vec3 normal = normal_of(one, face);
    const double height = normal.dot(one.centre) + one.half_along(normal);
    for (const Face& its : faces_of(other)) {
      const core::Vec3 its_normal = normal_of(other, its);
      const bool look_alike = (its_normal - normal).squaredNorm() <= least_lean * least_lean;
      const double its_height = normal.dot(other.centre) + other.half_along(its_normal);
      if (look_alike && std::abs(its_height - height) <= tolerance) return true;
    }
  }
  return false;
}

}  // namespace pbmpi::geometry
