#include "scenes/parts/mass_properties.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace pbmpi::scenes {
namespace {

using model::Shape;
using std::numbers::pi;

/// Volume and inertia by summing small cubes, as an oracle that uses no formula. `inside` tells whether a
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

/// 2 %: the error of cubes of 1/100 of the width along a curved surface.
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

// A bar cut into three parts, one of which is given lying and turned back.
TEST(MassProperties, of_parts_are_those_of_the_whole) {
  const core::Quat quarter_turn{std::sqrt(0.5), 0, std::sqrt(0.5), 0};  // about y: turns z to x
  const std::vector<Solid> parts = {{Shape::box, {1, 0.2, 0.3}, {{0.5, 0, 0}, {}}},
                                    {Shape::box, {2, 0.2, 0.3}, {{2, 0, 0}, {}}},
                                    {Shape::box, {0.3, 0.2, 3}, {{4.5, 0, 0}, quarter_turn}}};
  const MassProperties found = mass_properties(parts, 12);
  EXPECT_NEAR(volume(parts), 6 * 0.2 * 0.3, 1e-15);
  EXPECT_EQ(found.mass_kg, 12);
  EXPECT_LT((found.centre - model::Vec3(3, 0, 0)).norm(), 1e-14);  // rounding
  EXPECT_TRUE(found.inertia.isApprox(solid_inertia(Shape::box, {6, 0.2, 0.3}, 12), 1e-14)) << found.inertia;
}

TEST(MassProperties, of_one_part_in_its_frame_have_the_bits_of_its_shape) {
  for (const Shape shape : {Shape::sphere, Shape::box, Shape::capsule, Shape::cylinder}) {
    const std::array<double, 3> size = {0.31, 0.47, 0.12};
    const MassProperties found = mass_properties({{shape, size, {}}}, 1.7);
    EXPECT_EQ(found.centre, model::Vec3(0, 0, 0));
    EXPECT_EQ(found.inertia, solid_inertia(shape, size, 1.7));
  }
}

}  // namespace
}  // namespace pbmpi::scenes
