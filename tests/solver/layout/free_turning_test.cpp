#include "solver/layout/free_turning.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace pbmpi::solver {
namespace {

/// A slot of bodies in single precision that turn slowly, each lane in its own way. Neither the orientation
/// nor the principal axes have numbers that single precision holds.
template <class T>
struct Slot {
  using V = typename T::V;

  explicit Slot(const V& exact_lanes) : exact(exact_lanes) {
    const double root = std::sqrt(0.5), third = std::sqrt(1.0 / 3);
    axes = {number(root), number(0), number(root), number(0), {number(1), number(1 / 1.7), number(1 / 2.9)}};
    body = BodyLane<V>{};
    body.qw = body.qx = body.qy = number(third);
    body.qz = number(0);
    body.rotation = to_matrix(body.qw, body.qx, body.qy, body.qz);
    const V zero = number(0);
    twist = {{zero, zero, zero}, {number(0.11), number(-0.2), number(0.16)}};
    for (int lane = 0; lane < T::num_lanes; ++lane) {
      const auto faster = static_cast<typename T::Scalar>(1 + 0.2 * lane);
      T::set(twist.angular.x, lane, T::get(twist.angular.x, lane) * faster);
    }
  }
  static V number(double value) { return T::broadcast(static_cast<typename T::Scalar>(value)); }
  void advance(int substeps) {
    for (int i = 0; i < substeps; ++i)
      integrate_turning<T, false>(axes, static_cast<typename T::Scalar>(0.01 / 14), number(1), exact, body,
                                  twist);
  }
  /// Twice the energy of a lane, and the square of its momentum.
  std::array<double, 2> measured(int lane) const {
    const auto at = [lane](const V& v) { return static_cast<double>(T::get(v, lane)); };
    const auto square = [&](const Vec3L<V>& v) {
      return at(v.x) * at(v.x) + at(v.y) * at(v.y) + at(v.z) * at(v.z);
    };
    const Mat3L<V> to_body = to_matrix(axes.w, axes.x, axes.y, axes.z);
    const Vec3L<V> spin = to_body.transposed_times(body.rotation.transposed_times(twist.angular));
    const auto& per = axes.per_moment;
    const Vec3L<V> momentum{spin.x / per.x, spin.y / per.y, spin.z / per.z};
    return {at(dot(spin, momentum)), square(momentum)};
  }

  V exact;
  PrincipalInertia<V> axes;
  BodyLane<V> body;
  Twist<V> twist;
};

constexpr int a_minute = 84000;  // substeps

// In single precision alone this body gains or loses about 1 % of its energy. The bound: rounding of either
// side, 2^-24 in each of three components and in each substep, wanders by 2e-5 in a minute.
TEST(FreeTurning, keeps_energy_and_momentum_in_single_precision_where_joints_are_exact) {
  Slot<LaneTraits<float, 1>> slot(1);
  const auto before = slot.measured(0);
  slot.advance(a_minute);
  const auto after = slot.measured(0);
  EXPECT_NEAR(after[0] / before[0], 1, 1e-4);
  EXPECT_NEAR(after[1] / before[1], 1, 1e-4);
}

TEST(FreeTurning, moves_exact_bodies_in_single_as_in_double_precision) {
  Slot<LaneTraits<float, 1>> single(1);
  Slot<LaneTraits<double, 1>> both(1);
  single.advance(1400);
  both.advance(1400);
  EXPECT_NEAR(static_cast<double>(single.body.qw), both.body.qw, 1e-5);
  EXPECT_NEAR(static_cast<double>(single.twist.angular.x), both.twist.angular.x, 1e-5);
}

// Each lane as if it were alone, whether its neighbours are exact or not.
TEST(FreeTurning, gives_a_lane_the_same_bits_whatever_is_beside_it) {
  using Four = LaneTraits<float, 4>;
  using One = LaneTraits<float, 1>;
  Slot<Four> four(Four::V{1, 0, 0, 1});
  four.advance(500);
  for (int lane = 0; lane < 4; ++lane) {
    Slot<One> alone(Four::get(four.exact, lane));
    alone.twist.angular.x = Four::get(Slot<Four>(four.exact).twist.angular.x, lane);
    alone.advance(500);
    EXPECT_EQ(alone.body.qw, Four::get(four.body.qw, lane)) << lane;
    EXPECT_EQ(alone.body.qz, Four::get(four.body.qz, lane)) << lane;
    EXPECT_EQ(alone.twist.angular.x, Four::get(four.twist.angular.x, lane)) << lane;
    EXPECT_EQ(alone.twist.angular.z, Four::get(four.twist.angular.z, lane)) << lane;
  }
}

}  // namespace
}  // namespace pbmpi::solver
