// The air slows bodies down: the effects "drag" and "damping".
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "../helpers.h"
#include "stepped_scene.h"

namespace pbmpi::scenes {
namespace {

using effects::EffectId;
using std::numbers::pi;

/// Cd A [m^2] as in scenes/FORMAT.md: a quarter of the surface.
double drag_area(const model::Geom& geom) {
  const auto& [a, b, c] = geom.size;
  return geom.shape == model::Shape::sphere ? 0.47 * pi * a * a : 1.05 * (a * b + b * c + c * a) / 2;
}

/// [m/s] Speed at which drag balances weight.
double terminal_speed(const model::Model& model, const std::string& name) {
  for (const model::Geom& geom : model.geoms) {
    if (geom.body == model::no_body || model.bodies[geom.body].name != name) continue;
    const double weight = model.bodies[geom.body].mass_kg * -model.gravity.z();
    return std::sqrt(2 * weight / (model.air_density * drag_area(geom)));
  }
  ADD_FAILURE() << name;
  return 0;
}

int index_of(const model::Model& model, const std::string& name) {
  return static_cast<int>(&body(model, name) - model.bodies.data());
}

class Feathers : public testing::TestWithParam<SteppedBy> {};

INSTANTIATE_TEST_SUITE_P(EveryStepper, Feathers, testing::ValuesIn(every_stepper()),
                         [](const auto& test) { return test.param.name; });

// A body that falls from rest has the speed v tanh(g t / v), where v is the terminal speed. The error of a
// step of h is g h / 2, 0.6 % of the feather's speed, and that of single precision is less.
TEST_P(Feathers, fall_as_the_formula_says) {
  SteppedScene scene("Feathers", {}, GetParam().settings);
  scene.seconds(0.96);  // the steel balls land after 1.01 s
  for (const char* kind : {"feather", "table_tennis_ball", "steel_ball"}) {
    const double terminal = terminal_speed(scene.model(), kind + std::string(".1"));
    const double speed = terminal * std::tanh(9.81 * scene.time_s() / terminal);
    for (int copy = 1; copy <= 6; ++copy) {
      const std::string name = kind + ("." + std::to_string(copy));
      EXPECT_NEAR(scene.state().velocity[index_of(scene.model(), name)].z(), -speed, 0.01 * speed) << name;
    }
  }
}

TEST_P(Feathers, have_reached_their_terminal_speed_when_the_balls_have_landed) {
  SteppedScene scene("Feathers", {}, GetParam().settings);
  scene.seconds(1.5);
  const double terminal = terminal_speed(scene.model(), "feather.1");
  EXPECT_NEAR(scene.state().velocity[index_of(scene.model(), "feather.1")].z(), -terminal, 0.01 * terminal);
  EXPECT_NEAR(scene.state().position[index_of(scene.model(), "steel_ball.1")].z(), 0.05, 1e-3);
  EXPECT_GT(scene.state().position[index_of(scene.model(), "feather.1")].z(), 3.5);
}

// Torque-free except for the damping: the angular momentum decays as exp(-2 t).
TEST_P(Feathers, stop_tumbling) {
  SteppedScene scene("Feathers", {}, GetParam().settings);
  const int feather = index_of(scene.model(), "feather.1");
  const auto momentum = [&] {
    const core::Mat3 axes = scene.state().orientation[feather].to_eigen().toRotationMatrix();
    return Vec3(axes * scene.model().bodies[feather].inertia * axes.transpose() *
                scene.state().angular_velocity[feather]);
  };
  scene.steps(0);
  const Vec3 start = momentum();
  scene.seconds(1);
  EXPECT_LT((momentum() - std::exp(-2) * start).norm(), 0.02 * std::exp(-2) * start.norm());
}

TEST(FeathersPlan, calls_for_drag_and_damping) {
  const SteppedScene scene("Feathers");
  EXPECT_EQ(scene.reason(EffectId::drag), "18 bodies in air of 1.2 kg/m^3");
  EXPECT_EQ(scene.reason(EffectId::damping), "18 bodies at 0 1/s linear, 2 1/s angular");
}

TEST(FeathersPlan, without_drag_all_fall_alike) {
  SteppedScene scene("Feathers", {{"drag", false}});
  scene.seconds(0.96);
  for (const core::Vec3& velocity : scene.state().velocity) EXPECT_NEAR(velocity.z(), -9.81 * 0.96, 1e-9);
}

}  // namespace
}  // namespace pbmpi::scenes
