#include "geometry/measures.h"

#include <algorithm>
#include <numbers>

#include "core/error.h"
#include "geometry/geometry.h"

namespace pbmpi::geometry {
namespace {

using model::Shape;
using std::numbers::pi;

model::Mat3 diagonal(double xx, double yy, double zz) { return model::Vec3(xx, yy, zz).asDiagonal(); }

model::Mat3 capsule_inertia(double radius, double length, double mass) {
  // A cylinder, and a ball that is cut in two halves at the cylinder's ends; each half has its centre of mass
  // 3/8 r from the cut.
  const double cylinder = volume(Shape::cylinder, {radius, length, 0});
  const double ball = volume(Shape::sphere, {radius, 0, 0});
  const double cylinder_mass = mass * cylinder / (cylinder + ball);
  const double ball_mass = mass - cylinder_mass;
  const double across =
      cylinder_mass * (radius * radius / 4 + length * length / 12) +
      ball_mass * (0.4 * radius * radius + 0.375 * radius * length + 0.25 * length * length);
  const double along = (0.5 * cylinder_mass + 0.4 * ball_mass) * radius * radius;
  return diagonal(across, across, along);
}

}  // namespace

double volume(Shape shape, const std::array<double, 3>& size) {
  const double radius = size[0];
  switch (shape) {
    case Shape::sphere:
      return 4.0 / 3.0 * pi * radius * radius * radius;
    case Shape::box:
      return size[0] * size[1] * size[2];
    case Shape::capsule:
      return pi * radius * radius * (size[1] + 4.0 / 3.0 * radius);
    case Shape::cylinder:
      return pi * radius * radius * size[1];
    case Shape::plane:
    case Shape::hull:
    case Shape::mesh:
      break;
  }
  core::require_invariant(false, "volume() of a shape with sizes");
  return 0;
}

model::Mat3 solid_inertia(Shape shape, const std::array<double, 3>& size, double mass_kg) {
  const double m = mass_kg;
  const double rr = size[0] * size[0];
  switch (shape) {
    case Shape::sphere:
      return diagonal(0.4 * m * rr, 0.4 * m * rr, 0.4 * m * rr);
    case Shape::box: {
      const double yy = size[1] * size[1];
      const double zz = size[2] * size[2];
      return diagonal(m / 12 * (yy + zz), m / 12 * (rr + zz), m / 12 * (rr + yy));
    }
    case Shape::capsule:
      return capsule_inertia(size[0], size[1], m);
    case Shape::cylinder: {
      const double across = m * (rr / 4 + size[1] * size[1] / 12);
      return diagonal(across, across, m * rr / 2);
    }
    case Shape::plane:
    case Shape::hull:
    case Shape::mesh:
      break;
  }
  core::require_invariant(false, "solid_inertia() of a shape with sizes");
  return model::Mat3::Identity();
}

double drag_area(const model::Geom& geom) {
  constexpr double cd_round = 0.47, cd_box = 1.05, cd_cylinder = 0.82;
  const auto& [a, b, c] = geom.size;
  switch (geom.shape) {
    case Shape::sphere:
      return cd_round * pi * a * a;
    case Shape::capsule:
      return cd_round * pi * a * (a + b / 2);
    case Shape::cylinder:
      return cd_cylinder * pi * a * (a + b) / 2;
    case Shape::box:
      return cd_box * (a * b + b * c + c * a) / 2;
    case Shape::hull:
      return cd_box * geom.hull->surface / 4;
    case Shape::plane:
    case Shape::mesh:
      break;
  }
  return 0;
}

std::vector<double> sizes_of(const model::Model& model) {
  std::vector<double> sizes(model.bodies.size(), 0);
  for (const model::Geom& geom : model.geoms) {
    if (geom.body == model::no_body || geom.shape == Shape::plane) continue;
    const double radius = geom.local.position.norm() + bounding_radius(geom);
    sizes[geom.body] = std::max(sizes[geom.body], 2 * radius);
  }
  return sizes;
}

}  // namespace pbmpi::geometry
