/// Balls without friction, whose contact rows have no angular part.
#include <gtest/gtest.h>

#include "core/hash.h"
#include "model/names.h"
#include "solver/sor_run.h"
#include "stepping/names.h"
#include "stepping/stepper_traits.h"
#include "support/models.h"

namespace pbmpi::solver {
namespace {

constexpr int num_steps = 80;  // the first balls touch the ground after 10 steps, each other after 15

stepping::StepperSettings sor_settings(stepping::Precision precision = stepping::Precision::double_,
                                       stepping::Simd simd = stepping::Simd::automatic) {
  stepping::StepperSettings settings = default_settings(stepping::StepperKind::sor, stepping::Law::ode);
  settings.precision = precision;
  settings.simd = simd;
  return settings;
}

std::vector<model::Model> worlds_of_balls(const model::EffectChoices& effects) {
  std::vector<model::Model> worlds;
  for (int variant = 0; variant < 5; ++variant) {
    worlds.push_back(support::falling_balls(3, 0, variant));
    worlds.back().effects = effects;
  }
  return worlds;
}

std::vector<std::uint64_t> hashes_after(const stepping::StepperSettings& settings,
                                        const std::vector<model::Model>& worlds) {
  const auto stepper = make_stepper(settings, worlds);
  advance(*stepper, num_steps);
  std::vector<std::uint64_t> result;
  for (std::size_t i = 0; i < worlds.size(); ++i) result.push_back(hash(stepper->state(static_cast<int>(i))));
  return result;
}

class Balls : public testing::TestWithParam<stepping::Precision> {};

TEST_P(Balls, end_in_the_same_bits_with_friction_demanded_and_for_every_width) {
  const auto expected = hashes_after(sor_settings(GetParam(), stepping::Simd::off), worlds_of_balls({}));
  for (const stepping::Simd simd : machine_simds()) {
    const stepping::StepperSettings settings = sor_settings(GetParam(), simd);
    EXPECT_EQ(hashes_after(settings, worlds_of_balls({})), expected) << name_of(simd);
    EXPECT_EQ(hashes_after(settings, worlds_of_balls({{"friction", true}})), expected)
        << name_of(simd) << ", friction demanded";
  }
}

TEST_P(Balls, do_not_notice_worlds_whose_contacts_turn_bodies) {
  const auto alone = hashes_after(sor_settings(GetParam()), worlds_of_balls({}));
  std::vector<model::Model> worlds = worlds_of_balls({});
  worlds.insert(worlds.begin() + 2, support::pile(12));
  const auto together = hashes_after(sor_settings(GetParam()), worlds);
  EXPECT_EQ(together[1], alone[1]);
  EXPECT_EQ(together[3], alone[2]) << "behind the pile";
}

TEST_P(Balls, keep_their_spin_to_the_bit) {
  model::Model model = support::falling_balls(3, 0);
  for (model::Body& body : model.bodies) body.angular_velocity = {1.25, -0.5, 3};
  const auto stepper = make_stepper(sor_settings(GetParam()), {model});
  advance(*stepper, num_steps);
  EXPECT_GT(stepper->observables(0).contacts, 9) << "they lie on the ground";
  for (const model::Vec3& omega : stepper->state(0).angular_velocity)
    EXPECT_EQ(omega, model::Vec3(1.25, -0.5, 3));
}

INSTANTIATE_TEST_SUITE_P(, Balls, testing::Values(stepping::Precision::double_, stepping::Precision::single),
                         [](const auto& test) { return std::string(name_of(test.param)); });

TEST(BallsAndOthers, balls_that_meet_pass_their_momentum_on) {
  model::Model model = support::falling_balls(3, 0);
  model.geoms.pop_back();  // the ground
  model.gravity = {0, 0, 0};
  for (std::size_t i = 0; i < model.bodies.size(); ++i)
    model.bodies[i].velocity = model::Vec3(0.6, 0.6, 0) - model.bodies[i].pose.position;
  const auto stepper = make_stepper(sor_settings(), {model});
  const auto momentum = [&] {
    model::Vec3 sum{0, 0, 0};
    for (std::size_t i = 0; i < model.bodies.size(); ++i)
      sum += model.bodies[i].mass_kg * stepper->state(0).velocity[i];
    return sum;
  };
  const model::Vec3 before = momentum();
  int contacts = 0;
  for (int i = 0; i < num_steps; ++i) {
    advance(*stepper, 1);
    contacts += stepper->observables(0).contacts;
  }
  EXPECT_GT(contacts, 100) << "they meet";
  EXPECT_LT((momentum() - before).norm(), 1e-12)
      << "equal masses get equal changes: rounding of sums [kg m/s]";
}

TEST(BallsAndOthers, a_sphere_off_its_bodys_centre_is_turned_by_the_ground) {
  model::Model model = support::falling_balls(1, 0);
  model.geoms.front().local.position = {0.1, 0, 0};
  const auto stepper = make_stepper(sor_settings(), {model});
  advance(*stepper, 20);  // it touches the ground after 10 steps
  EXPECT_GT(stepper->state(0).angular_velocity.front().norm(), 0.1) << "it rolls over its lowest point";
}

}  // namespace
}  // namespace pbmpi::solver
