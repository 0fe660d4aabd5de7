#include "stability/cases/case_watch.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "model/mechanics.h"
#include "support/models.h"

namespace pbmpi::stability {
namespace {

using model::Model;
using model::State;

constexpr double dt_s = 0.01;

HardCase case_of(double seconds) {
  HardCase hard_case;
  hard_case.seconds = seconds;
  hard_case.settle_s = 0;
  return hard_case;
}

stepping::Observables seen(const Model& model, const State& state) {
  stepping::Observables seen;
  observe_state(model, state, seen);
  return seen;
}

void see(CaseWatch& watch, const Model& model, const State& state, std::int64_t step) {
  watch.see(state, seen(model, state), step);
}

TEST(CaseWatch, measures_the_longest_way_and_the_deepest_descent_of_watched_bodies) {
  const Model model = support::pile(2);
  HardCase hard_case = case_of(1);
  hard_case.watch = {model.bodies[1].name};
  CaseWatch watch(hard_case, model, dt_s);
  State state = initial_state(model);
  state.position[0].x() += 5;  // this body is not watched
  state.position[1] += model::Vec3(0.3, 0, -0.4);
  see(watch, model, state, 1);
  state.position[1] -= model::Vec3(0.3, 0, -0.4);
  see(watch, model, state, 2);
  EXPECT_NEAR(watch.metric(Metric::drift), 0.5, 1e-12);
  EXPECT_NEAR(watch.metric(Metric::sink), 0.4, 1e-12);
}

TEST(CaseWatch, counts_speed_from_the_time_on_at_which_the_case_has_settled) {
  const Model model = support::free_box();
  HardCase hard_case = case_of(1);
  hard_case.settle_s = 0.5;
  CaseWatch watch(hard_case, model, dt_s);
  State state = initial_state(model);
  state.velocity[0] = {7, 0, 0};
  see(watch, model, state, 49);
  EXPECT_EQ(watch.metric(Metric::speed), 0);
  state.velocity[0] = {0, 2, 0};
  see(watch, model, state, 50);
  EXPECT_EQ(watch.metric(Metric::speed), 2);
}

TEST(CaseWatch, measures_creep_over_the_second_half) {
  const Model model = support::pile(1);
  CaseWatch watch(case_of(1), model, dt_s);
  State state = initial_state(model);
  for (int step = 1; step <= 100; ++step) {
    // A jump in the first half is not creep; then 3 mm/s.
    state.position[0].x() = step < 20 ? 0 : 0.5 + 0.003 * std::max(0, step - 50) * dt_s;
    see(watch, model, state, step);
  }
  EXPECT_NEAR(watch.metric(Metric::creep), 0.003, 1e-9);
}

TEST(CaseWatch, has_worst_and_rms_of_the_joints_gaps) {
  const Model model = support::chain(1);
  CaseWatch watch(case_of(1), model, dt_s);
  State state = initial_state(model);
  state.position[0].x() += 0.03;
  see(watch, model, state, 1);
  state.position[0].x() += 0.01;
  see(watch, model, state, 2);
  EXPECT_NEAR(watch.metric(Metric::joint_gap), 0.04, 1e-12);
  EXPECT_NEAR(watch.metric(Metric::joint_gap_rms), std::sqrt((0.03 * 0.03 + 0.04 * 0.04) / 2), 1e-12);
}

TEST(CaseWatch, counts_bodies_that_are_outside_of_the_region_at_once) {
  const Model model = support::pile(3);
  HardCase hard_case = case_of(1);
  hard_case.region.high.x() = 10;
  CaseWatch watch(hard_case, model, dt_s);
  State state = initial_state(model);
  state.position[0].x() = state.position[2].x() = 11;
  see(watch, model, state, 1);
  state = initial_state(model);
  see(watch, model, state, 2);
  EXPECT_EQ(watch.metric(Metric::escaped), 2);
}

TEST(CaseWatch, takes_angular_momentum_about_the_centre_of_mass) {
  Model model = support::free_box();
  model.bodies[0].angular_velocity = {0, 0, 2};
  model.bodies[0].velocity = {3, 0, 0};
  CaseWatch watch(case_of(1), model, dt_s);
  State state = initial_state(model);
  state.position[0] += model::Vec3(0, 50, 0);  // about the origin this would be another value
  see(watch, model, state, 1);
  EXPECT_NEAR(watch.metric(Metric::angular_momentum), 0, 1e-12);
  state.angular_velocity[0].z() = 2.2;
  see(watch, model, state, 2);
  EXPECT_NEAR(watch.metric(Metric::angular_momentum), 0.1, 1e-12);
}

TEST(CaseWatch, compares_a_quantity_at_its_time_with_what_is_expected) {
  const Model model = support::free_box();
  HardCase hard_case = case_of(1);
  hard_case.expectations = {{model.bodies[0].name, Quantity::x, 0.5, 3, {0.1, 1}},
                            {model.bodies[0].name, Quantity::speed, 1, 0, {0.1, 1}}};
  CaseWatch watch(hard_case, model, dt_s);
  State state = initial_state(model);
  state.position[0].x() = 2.75;
  see(watch, model, state, 50);
  state.position[0].x() = 9;
  see(watch, model, state, 51);
  EXPECT_NEAR(watch.result().expected_off[0], 0.25, 1e-12);
  EXPECT_TRUE(std::isnan(watch.result().expected_off[1])) << "the run ended before";
}

TEST(CaseWatch, takes_the_first_state_after_the_time_if_it_sees_only_some) {
  const Model model = support::free_box();
  HardCase hard_case = case_of(1);
  hard_case.expectations = {{model.bodies[0].name, Quantity::x, 0.5, 3, {0.1, 1}}};
  CaseWatch watch(hard_case, model, dt_s);
  State state = initial_state(model);
  for (const std::int64_t step : {47, 52, 57}) {
    state.position[0].x() = static_cast<double>(step) / 10;
    see(watch, model, state, step);
  }
  EXPECT_NEAR(watch.result().expected_off[0], 2.2, 1e-12) << "of step 52";
}

TEST(CaseWatch, notes_when_a_limit_was_first_passed) {
  const Model model = support::free_box();
  HardCase hard_case = case_of(1);
  hard_case.bounds = {{Metric::drift, {0.1, 0.2}}};
  CaseWatch watch(hard_case, model, dt_s);
  State state = initial_state(model);
  for (int step = 1; step <= 10; ++step) {
    state.position[0].x() += 0.05;
    see(watch, model, state, step);
  }
  EXPECT_NEAR(watch.result().broken_at_s, 0.05, 1e-12);
}

TEST(CaseWatch, makes_a_lost_body_infinite) {
  const Model model = support::free_box();
  CaseWatch watch(case_of(1), model, dt_s);
  State state = initial_state(model);
  state.position[0].x() = NAN;
  see(watch, model, state, 1);
  EXPECT_EQ(watch.metric(Metric::nonfinite), 1);
  EXPECT_TRUE(std::isinf(watch.metric(Metric::drift)));
  EXPECT_TRUE(std::isinf(watch.metric(Metric::energy_gain)));
}

TEST(CaseWatch, refuses_bodies_that_the_scene_lacks) {
  const Model model = support::free_box();
  HardCase hard_case = case_of(1);
  hard_case.watch = {"nobody"};
  EXPECT_THROW(CaseWatch(hard_case, model, dt_s), core::InputError);
  hard_case = case_of(1);
  hard_case.expectations = {{"nobody", Quantity::x, 1, 0, {}}};
  EXPECT_THROW(CaseWatch(hard_case, model, dt_s), core::InputError);
}

}  // namespace
}  // namespace pbmpi::stability
