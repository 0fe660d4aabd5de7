#include "scenes/parts/mass_properties.h"

#include <gtest/gtest.h>

#include <numbers>

namespace pbmpi::scenes {
namespace {

using model::Shape;
using std::numbers::pi;

/// Volume and inertia by summing small cubes, as an oracle that knows no formula. `inside` tells whether a
/// point belongs to the shape, which lies within [-half, half]^3.
template <class Inside>
std::pair<double, model::Mat3> summed(double half, Inside inside) {
  constexpr int cells = 100;
  const double step = 2 * half / cells;
  double volume = 0;
  model::Mat3 inertia = model::Mat3::Zero();
  for (int i = 0; i < cells; ++i) {
    for (int j = 0; j < cells; ++j) {
      for (int k = 0; k < cells; ++k) {
        const model::Vec3 p = model::Vec3(i + 0.5, j + 0.5, k + 0.5) * step - model::Vec3::Constant(half);
        if (!inside(p)) continue;
        volume += step * step * step;
        inertia += step * step * step * (p.squaredNorm() * model::Mat3::Identity() - p * p.transpose());
      }
    }
  }
  return {volume, inertia};
}

/// 2 %: the staircase of cubes of 1/100 of the width along a curved surface.
constexpr double tolerance = 0.02;

template <class Inside>
void expect_like_sum(Shape shape, const std::array<double, 3>& size, double half, Inside inside) {
  const auto [sum, inertia] = summed(half, inside);
  EXPECT_NEAR(volume(shape, size), sum, tolerance * sum);
  EXPECT_TRUE(solid_inertia(shape, size, sum).isApprox(inertia, tolerance))
      << solid_inertia(shape, size, sum);
}

TEST(MassProperties, of_a_box_are_those_of_its_small_cubes) {
  expect_like_sum(Shape::box, {0.8, 0.6, 0.4}, 0.4, [](const model::Vec3& p) {
    return std::abs(p.x()) < 0.4 && std::abs(p.y()) < 0.3 && std::abs(p.z()) < 0.2;
  });
}

TEST(MassProperties, of_a_sphere_are_those_of_its_small_cubes) {
  expect_like_sum(Shape::sphere, {0.5, 0, 0}, 0.5, [](const model::Vec3& p) { return p.norm() < 0.5; });
}

TEST(MassProperties, of_a_cylinder_are_those_of_its_small_cubes) {
  expect_like_sum(Shape::cylinder, {0.3, 0.8, 0}, 0.4,
                  [](const model::Vec3& p) { return p.head<2>().norm() < 0.3 && std::abs(p.z()) < 0.4; });
}

TEST(MassProperties, of_a_capsule_are_those_of_its_small_cubes) {
  expect_like_sum(Shape::capsule, {0.2, 0.4, 0}, 0.4, [](const model::Vec3& p) {
    const double beyond = std::max(0.0, std::abs(p.z()) - 0.2);
    return std::hypot(p.head<2>().norm(), beyond) < 0.2;
  });
}

TEST(MassProperties, of_a_capsule_without_length_are_those_of_a_sphere) {
  const auto capsule = solid_inertia(Shape::capsule, {0.3, 1e-12, 0}, 2);
  EXPECT_TRUE(capsule.isApprox(solid_inertia(Shape::sphere, {0.3, 0, 0}, 2), 1e-9));  // of the length, 1e-12
}

}  // namespace
}  // namespace pbmpi::scenes
