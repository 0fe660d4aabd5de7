#include "model/mechanics.h"

#include <gtest/gtest.h>

#include "support/models.h"
#include "support/random_state.h"

namespace pbmpi::model {
namespace {

/// Tolerance for numbers of size 10 to 1000 after some dozen roundings.
constexpr double rounding = 1e-12;

Model two_boxes() {
  Model model;
  const int actor = support::add_actor(model, "boxes");
  support::add_solid(model, actor, "a", Shape::box, {1, 1, 1}, 2, {0, 0, 3});
  support::add_solid(model, actor, "b", Shape::box, {1, 1, 1}, 6, {2, 0, 0.5});
  return model;
}

TEST(MechanicalEnergy, of_two_bodies_is_what_a_pencil_gives) {
  Model model = two_boxes();
  model.bodies[0].velocity = {3, 0, 4};          // 1/2 * 2 * 25 = 25 J
  model.bodies[1].angular_velocity = {0, 0, 2};  // I = 6 / 6 = 1: 2 J
  const double potential = 2 * 9.81 * 3 + 6 * 9.81 * 0.5;
  EXPECT_NEAR(mechanical_energy(model, initial_state(model)), 25 + 2 + potential, rounding * 100);
}

TEST(MechanicalEnergy, takes_the_inertia_in_the_bodys_frame) {
  Model model;
  model.gravity.setZero();
  const int actor = support::add_actor(model, "rod");
  const Quat quarter = support::rotation(Vec3::UnitX(), std::acos(-1.0) / 2);  // turns z to the world's -y
  support::add_solid(model, actor, "rod", Shape::box, {0.2, 0.2, 2}, 12, {0, 0, 0}, quarter);
  const double along = 12 * (0.04 + 0.04) / 12;
  model.bodies[0].angular_velocity = {0, 10, 0};
  EXPECT_NEAR(mechanical_energy(model, initial_state(model)), 0.5 * along * 100, rounding * 100);
}

TEST(Momentum, a_free_box_has_that_of_its_mass_and_spin) {
  const Model model = support::free_box();
  State state = initial_state(model);
  state.position[0] = Vec3(1, 0, 0);
  state.orientation[0] = {};
  state.velocity[0] = Vec3(0, 2, 0);
  state.angular_velocity[0] = Vec3(0, 0, 4);
  const model::Body& box = model.bodies[0];
  EXPECT_EQ(linear_momentum(model, state), Vec3(0, 2 * box.mass_kg, 0));
  const Vec3 expected = box.inertia * Vec3(0, 0, 4) + Vec3(0, 0, 2 * box.mass_kg);
  EXPECT_NEAR((angular_momentum(model, state) - expected).norm(), 0, 1e-13);  // numbers of size 10
}

/// Every bit of every number counts: recorded runs are compared by them.
TEST(MechanicsMeter, gives_the_plain_sums_over_the_bodies_to_the_bit) {
  const Model model = support::crash();
  const MechanicsMeter meter(model);
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const State state = support::random_state(model, seed);
    double energy_j = 0;
    Vec3 linear = Vec3::Zero(), angular = Vec3::Zero();
    for (int i = 0; i < model.num_bodies(); ++i) {
      const Body& body = model.bodies[i];
      const auto turn = state.orientation[i].to_eigen();
      const Vec3 spin = turn * (body.inertia * (turn.conjugate() * state.angular_velocity[i]));
      energy_j += body_energy(model, state, i);
      linear += body.mass_kg * state.velocity[i];
      angular += spin + body.mass_kg * state.position[i].cross(state.velocity[i]);
    }
    const Mechanics measured = meter.measure(state);
    ASSERT_EQ(measured.energy_j, energy_j) << "seed " << seed;
    ASSERT_EQ(measured.linear_momentum, linear) << "seed " << seed;
    ASSERT_EQ(measured.angular_momentum, angular) << "seed " << seed;
  }
}

}  // namespace
}  // namespace pbmpi::model
