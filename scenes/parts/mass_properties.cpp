#include "scenes/parts/mass_properties.h"

#include <Eigen/Eigenvalues>

namespace pbmpi::scenes {

bool is_of_a_body(const model::Mat3& inertia) {
  constexpr double rounding = 1e-3;
  const Eigen::SelfAdjointEigenSolver<model::Mat3> moments(inertia, Eigen::EigenvaluesOnly);
  return 2 * moments.eigenvalues().maxCoeff() <= (1 + rounding) * moments.eigenvalues().sum();
}

double volume(const Solid& solid) {
  return solid.hull != nullptr ? solid.hull->volume : volume(solid.shape, solid.size);
}

double volume(const std::vector<Solid>& solids) {
  double sum = 0;
  for (const Solid& solid : solids) sum += volume(solid);
  return sum;
}

model::Mat3 steiner(double mass_kg, const model::Vec3& arm) {
  return mass_kg * (arm.squaredNorm() * model::Mat3::Identity() - arm * arm.transpose());
}

namespace {

/// About its centre of mass, in its own axes.
model::Mat3 inertia_of(const Solid& solid, double mass_kg) {
  if (solid.hull != nullptr) return mass_kg / solid.hull->volume * solid.hull->inertia;
  return solid_inertia(solid.shape, solid.size, mass_kg);
}

}  // namespace

MassProperties mass_properties(const std::vector<Solid>& solids, double mass_kg) {
  const double whole = volume(solids);
  const auto share_of = [&](const Solid& solid) { return volume(solid) / whole; };
  MassProperties sum{mass_kg, model::Vec3::Zero(), model::Mat3::Zero()};
  for (const Solid& solid : solids) sum.centre += share_of(solid) * solid.pose.position;
  for (const Solid& solid : solids) {
    const double mass = share_of(solid) * mass_kg;
    const model::Mat3 axes = solid.pose.orientation.to_eigen().toRotationMatrix();
    const model::Vec3 arm = solid.pose.position - sum.centre;
    sum.inertia += axes * inertia_of(solid, mass) * axes.transpose();
    sum.inertia += steiner(mass, arm);
  }
  return sum;
}

}  // namespace pbmpi::scenes
