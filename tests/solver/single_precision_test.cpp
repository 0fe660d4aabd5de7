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
