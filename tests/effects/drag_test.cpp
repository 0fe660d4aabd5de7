#include "effects/drag.h"

#include <numbers>

#include <gtest/gtest.h>

#include "support/models.h"

namespace pbmpi::effects {
namespace {

constexpr double pi = std::numbers::pi;

model::Geom geom(model::Shape shape, std::array<double, 3> size) {
  model::Geom geom;
  geom.shape = shape;
  geom.size = size;
  return geom;
}

TEST(Drag, takes_a_quarter_of_the_surface_for_the_area) {
  EXPECT_DOUBLE_EQ(geometry::drag_area(geom(model::Shape::sphere, {2, 0, 0})), 0.47 * pi * 4);
  EXPECT_DOUBLE_EQ(geometry::drag_area(geom(model::Shape::box, {1, 2, 3})), 1.05 * (2 * (2 + 6 + 3)) / 4);
  EXPECT_DOUBLE_EQ(geometry::drag_area(geom(model::Shape::cylinder, {1, 3, 0})),
                   0.82 * (2 * pi + 2 * pi * 3) / 4);
  EXPECT_DOUBLE_EQ(geometry::drag_area(geom(model::Shape::capsule, {1, 3, 0})),
                   0.47 * (4 * pi + 2 * pi * 3) / 4);
  EXPECT_EQ(geometry::drag_area(geom(model::Shape::plane, {})), 0);
}

/// Two balls of 2 kg and a static ground in air.
model::Model balls_in_air(double density) {
  model::Model model;
  support::add_ground(model);
  const int actor = support::add_actor(model, "balls");
  for (int i = 0; i < 2; ++i)
    support::add_solid(model, actor, "ball" + std::to_string(i), model::Shape::sphere, {0.5, 0, 0}, 2,
                       {2.0 * i, 0, 5});
  model.air_density = density;
  return model;
}

TEST(Drag, slows_the_bodies_that_it_is_given_by_the_square_of_their_speed) {
  const model::Model model = balls_in_air(1.2);
  model::State state = model::initial_state(model);
  state.velocity[0] = state.velocity[1] = {3, 0, -4};
  state.angular_velocity[0] = {0, 7, 0};
  make_drag(model)(0.01, std::vector<int>{0}, state);
  const double k = 1.2 * 0.47 * pi * 0.25 / (2 * 2);
  EXPECT_NEAR((state.velocity[0] - core::Vec3(3, 0, -4) / (1 + k * 5 * 0.01)).norm(), 0, 1e-14);
  EXPECT_EQ(state.angular_velocity[0], core::Vec3(0, 7, 0));
  EXPECT_EQ(state.velocity[1], core::Vec3(3, 0, -4));
}

TEST(Drag, never_reverses_a_velocity) {
  const model::Model model = balls_in_air(1e9);
  model::State state = model::initial_state(model);
  state.velocity[0] = {100, 0, 0};
  make_drag(model)(1, std::vector<int>{0}, state);
  EXPECT_GT(state.velocity[0].x(), 0);
  EXPECT_LT(state.velocity[0].x(), 1e-6);
}

TEST(Drag, changes_no_bit_without_air) {
  const model::Model model = balls_in_air(0);
  model::State state = model::initial_state(model);
  state.velocity[0] = {1.0 / 3, -0.0, model::infinity};
  make_drag(model)(0.01, std::vector<int>{0, 1}, state);
  EXPECT_EQ(state.velocity[0], core::Vec3(1.0 / 3, -0.0, model::infinity));
  EXPECT_FALSE(StepPlan(model).has(EffectId::drag));
}

TEST(Drag, is_called_for_by_air_and_taken_out_with_it) {
  model::Model model = balls_in_air(1.2);
  const StepPlan plan(model);
  ASSERT_TRUE(plan.has(EffectId::drag));
  EXPECT_EQ(plan.passes().front().reason.text(), "2 bodies in air of 1.2 kg/m^3");
  effect_registry()[static_cast<std::size_t>(EffectId::drag)].leave_out(model);
  EXPECT_EQ(model.air_density, 0);
}

}  // namespace
}  // namespace pbmpi::effects
