#include "scenes/parts/mass_properties.h"

#include <numbers>

#include <Eigen/Eigenvalues>

#include "core/error.h"

namespace pbmpi::scenes {
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
      break;
  }
  core::require_invariant(false, "volume() of a plane");
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
      break;
  }
  core::require_invariant(false, "solid_inertia() of a plane");
  return model::Mat3::Identity();
}

bool is_of_a_body(const model::Mat3& inertia) {
  constexpr double rounding = 1e-3;
  const Eigen::SelfAdjointEigenSolver<model::Mat3> moments(inertia, Eigen::EigenvaluesOnly);
  return 2 * moments.eigenvalues().maxCoeff() <= (1 + rounding) * moments.eigenvalues().sum();
}

double volume(const std::vector<Solid>& solids) {
  double sum = 0;
  for (const Solid& solid : solids) sum += volume(solid.shape, solid.size);
  return sum;
}

MassProperties mass_properties(const std::vector<Solid>& solids, double mass_kg) {
  const double whole = volume(solids);
  const auto share_of = [&](const Solid& solid) { return volume(solid.shape, solid.size) / whole; };
  MassProperties sum{mass_kg, model::Vec3::Zero(), model::Mat3::Zero()};
  for (const Solid& solid : solids) sum.centre += share_of(solid) * solid.pose.position;
  for (const Solid& solid : solids) {
    const double mass = share_of(solid) * mass_kg;
    const model::Mat3 axes = solid.pose.orientation.to_eigen().toRotationMatrix();
    const model::Vec3 arm = solid.pose.position - sum.centre;
    sum.inertia += axes * solid_inertia(solid.shape, solid.size, mass) * axes.transpose();
    sum.inertia += mass * (arm.squaredNorm() * model::Mat3::Identity() - arm * arm.transpose());  // Steiner
  }
  return sum;
}

}  // namespace pbmpi::scenes
