#include "geometry/hulls/solid_integrals.h"

namespace pbmpi::geometry {

void SolidIntegrals::add(const core::Vec3& a, const core::Vec3& b, const core::Vec3& c) {
  const double six_volumes = a.dot(b.cross(c));
  const core::Vec3 sum = a + b + c;
  volume_ += six_volumes / 6;
  surface_ += (b - a).cross(c - a).norm() / 2;
  first_ += six_volumes / 24 * sum;
  second_ +=
      six_volumes / 120 * (sum * sum.transpose() + a * a.transpose() + b * b.transpose() + c * c.transpose());
}

core::Mat3 SolidIntegrals::inertia_about_centre() const {
  const core::Mat3 moments = second_ - volume_ * centre() * centre().transpose();
  return moments.trace() * core::Mat3::Identity() - moments;
}

}  // namespace pbmpi::geometry
