// In single precision each coordinate of a body is kept in two numbers.
#include <gtest/gtest.h>

#include <random>

#include "solver/layout/body_lanes.h"
#include "solver/sor_run.h"
#include "stepping/step_options.h"
#include "support/models.h"

namespace pbmpi::solver {
namespace {

using model::Model;
using Lane = LaneTraits<float, 1>;

stepping::StepperSettings single_sor() {
  stepping::StepperSettings settings = default_settings(stepping::StepperKind::sor);
  settings.precision = stepping::Precision::single;
  return settings;
}

const std::vector<double> places_m = {0, 0.3, -10, 1000};

/// Weightless balls, all with the same velocity in x and none near another.
Model slow_balls(double velocity) {
  Model model;
  model.gravity = {0, 0, 0};
  const int actor = support::add_actor(model, "balls");
  for (std::size_t i = 0; i < places_m.size(); ++i) {
    const int ball = support::add_solid(model, actor, "ball" + std::to_string(i), model::Shape::sphere,
                                        {0.1, 0, 0}, 1, {places_m[i], static_cast<double>(i), 0.7});
    model.bodies[static_cast<std::size_t>(ball)].velocity = {velocity, 0, 0};
  }
  return model;
}

TEST(SinglePrecision, a_body_goes_its_way_however_little_of_it_falls_on_a_substep) {
  constexpr double velocity = 1e-5;
  const Model model = slow_balls(velocity);
  const auto stepper = make_stepper(single_sor(), {model});
  constexpr int num_steps = 1000;
  advance(*stepper, num_steps);
  for (std::size_t i = 0; i < places_m.size(); ++i) {
    const double start = model::initial_state(model).position[static_cast<int>(i)].x();
    const double way = stepper->state(0).position[static_cast<int>(i)].x() - start;
    EXPECT_NEAR(way, velocity * 0.01 * num_steps, 1e-9 + 1e-12 * std::abs(start) * num_steps) << start;
  }
}

TEST(SinglePrecision, a_state_holds_the_whole_place) {
  for (const double velocity : {1e-5, 0.37, 12.5}) {
    const auto model = std::make_shared<const Model>(slow_balls(velocity));
    const auto whole = make_stepper(single_sor(), {*model});
    advance(*whole, 120);
    for (const int stop : {1, 7, 60}) {
      const auto first = make_stepper(single_sor(), {*model}), second = make_stepper(single_sor());
      advance(*first, stop);
      second->add(0, model, first->state(0), stop);
      advance(*second, 120 - stop);
      EXPECT_EQ(model::hash(second->state(0)), model::hash(whole->state(0))) << velocity << " at " << stop;
    }
  }
}

/// Two boxes that turn about each other on long arms, so that their joint is solved exactly, that far along
/// x.
Model turning_pair(double place_m) {
  Model model;
  model.gravity = {0, 0, 0};
  const int actor = support::add_actor(model, "pair");
  const int heavy =
      support::add_solid(model, actor, "heavy", model::Shape::box, {0.3, 0.2, 0.4}, 20, {place_m, 0, 0});
  const int light = support::add_solid(model, actor, "light", model::Shape::box, {0.2, 0.1, 0.3}, 0.1,
                                       {place_m + 1.5, 0.3, 0.7});
  support::add_joint(model, model::JointKind::ball, light, heavy, {place_m + 0.7, 0.1, 0.2});
  model.bodies[static_cast<std::size_t>(light)].velocity = {-0.4, 1.2, 0.3};
  model.bodies[static_cast<std::size_t>(heavy)].angular_velocity = {0.5, -1, 0.8};
  return model;
}

// Of a coordinate of 3 km one number holds 0.1 mm, by which joints would be shaken in each substep.
TEST(SinglePrecision, exact_joints_hold_as_well_far_from_the_origin) {
  const auto stepper = make_stepper(single_sor(), {turning_pair(0), turning_pair(3000)});
  for (int step = 0; step < 300; ++step) {
    advance(*stepper, 1);
    if (step < 10) continue;  // the start's velocities do not fit the joint
    for (const int world : {0, 1}) ASSERT_LT(stepper->observables(world).joint_gap_m, 2e-6) << world;
  }
}

// The high number alone is the position in single precision, and both together are a double.
TEST(SinglePrecision, the_two_numbers_of_a_place_add_up_to_a_double_and_lose_nothing_that_counts) {
  std::mt19937_64 engine(7);
  std::uniform_real_distribution<double> share(-1, 1), power(-12, 3);
  for (int run = 0; run < 200; ++run) {
    float place = static_cast<float>(share(engine) * std::pow(10, power(engine))), low = 0;
    double exact = place, lost = 0;  // bound: the rounding of the displacement, far less of the place
    for (int i = 0; i < 500; ++i) {
      const float way = static_cast<float>(share(engine) * std::pow(10, power(engine)));
      Lane::V high_lane = Lane::broadcast(place), low_lane = Lane::broadcast(low);
      move_by<Lane>(high_lane, low_lane, Lane::broadcast(way));
      place = Lane::get(high_lane, 0);
      low = Lane::get(low_lane, 0);
      exact += static_cast<double>(way);
      lost += std::abs(static_cast<double>(way)) * 0x1p-23 + std::abs(exact) * 0x1p-41;
      const double both = static_cast<double>(place) + static_cast<double>(low);
      ASSERT_EQ(static_cast<float>(both), place);
      ASSERT_EQ(static_cast<float>(both - static_cast<double>(place)), low);
      ASSERT_NEAR(both, exact, lost);
    }
  }
}

}  // namespace
}  // namespace pbmpi::solver
