#include "solver/worlds/sor_stepper.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "ode/ode_stepper.h"
#include "solver/sor_run.h"
#include "stepping/stepper_traits.h"
#include "support/models.h"

namespace pbmpi::solver {
namespace {

stepping::StepperSettings sor_settings() {
  stepping::StepperSettings settings = default_settings(stepping::StepperKind::sor, stepping::Law::ode);
  return settings;
}

std::unique_ptr<stepping::WorldStepper> quick(stepping::StepperSettings settings,
                                              const std::vector<model::Model>& worlds) {
  settings.kind = stepping::StepperKind::quick;
  auto stepper = ode::make_ode_stepper(settings);
  for (std::size_t i = 0; i < worlds.size(); ++i) {
    stepper->add(static_cast<int>(i), std::make_shared<const model::Model>(worlds[i]),
                 model::initial_state(worlds[i]), 0);
  }
  return stepper;
}

TEST(SorStepper, a_box_falls_as_the_semi_implicit_rule_says) {
  model::Model model = support::box_over_ground(100);
  const auto stepper = make_stepper(sor_settings(), {model});
  advance(*stepper, 50);
  // v = g t, z = z0 - g h^2 n (n + 1) / 2; 1e-12 is rounding of 50 sums.
  EXPECT_NEAR(stepper->state(0).velocity[0].z(), -9.81 * 0.5, 1e-12);
  EXPECT_NEAR(stepper->state(0).position[0].z(), 100.5 - 9.81 * 1e-4 * 50 * 51 / 2, 1e-11);
}

// Where nothing turns, a sum with a torque of 0 would make 0 of -0.
TEST(SorStepper, a_load_moves_no_bit_of_another_world) {
  model::Model model = support::box_over_ground(100);
  model.gravity = {0, 0, 0};
  model.bodies[0].angular_velocity = {-0.0, -0.0, -0.0};
  model.bodies[0].velocity = {-0.0, 1, 0};
  const auto alone = make_stepper(default_settings(stepping::StepperKind::sor), {model});
  const auto both = make_stepper(default_settings(stepping::StepperKind::sor), {model, model});
  both->set_load(1, 0, {.force = {1, 2, 3}, .torque = {0.1, 0.2, 0.3}});
  for (const auto& stepper : {alone.get(), both.get()}) advance(*stepper, 3);
  EXPECT_EQ(model::hash(both->state(0)), model::hash(alone->state(0)));
  EXPECT_GT(both->state(1).angular_velocity[0].z(), 0);
}

TEST(SorStepper, a_box_rests_on_the_ground) {
  const auto stepper = make_stepper(sor_settings(), {support::box_over_ground(0.01)});
  advance(*stepper, 200);
  EXPECT_LT(stepper->state(0).velocity[0].norm(), 1e-3) << "two seconds are enough to come to rest [m/s]";
  EXPECT_NEAR(stepper->state(0).position[0].z(), 0.5, 1e-3);
  EXPECT_EQ(stepper->observables(0).contacts, 4);
  EXPECT_EQ(stepper->observables(0).rows, 12);
  EXPECT_EQ(stepper->observables(0).islands, 1);
}

double largest_speed_difference(const model::State& a, const model::State& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.velocity.size(); ++i)
    largest = std::max(largest, (a.velocity[i] - b.velocity[i]).norm());
  return largest;
}

/// The state one step after `start`.
model::State one_step(std::unique_ptr<stepping::WorldStepper> stepper, const model::Model& model,
                      const model::State& start, std::int64_t step) {
  stepper->add(0, std::make_shared<const model::Model>(model), start, step);
  advance(*stepper, 1);
  return stepper->state(0);
}

/// Both iterate on the same rows towards the same solution. The size of the remaining error is seen from
/// QuickStep itself: the order of its rows, which follows the seed, changes its result by about as much as
/// the other solver does.
TEST(SorStepper, from_a_common_state_it_differs_from_quickstep_no_more_than_another_seed) {
  model::Model model = support::crash();
  model.effects["fast_bodies"] = false;  // the solvers are compared, with contacts that touch
  stepping::StepperSettings settings = sor_settings();
  const auto path = quick(settings, {model});
  settings.iterations = 3000;
  settings.kind = stepping::StepperKind::quick;
  settings.law.colliders = stepping::Colliders::ode;  // the same contacts on both sides
  int steps_with_impact = 0;
  for (int step = 0; step < 24; ++step) {
    const model::State start = path->state(0);
    settings.seed = 1;
    const model::State reference = one_step(ode::make_ode_stepper(settings), model, start, step);
    double floor = 0;
    for (settings.seed = 2; settings.seed < 6; ++settings.seed) {
      const model::State other = one_step(ode::make_ode_stepper(settings), model, start, step);
      floor = std::max(floor, largest_speed_difference(reference, other));
    }
    const model::State own = one_step(make_stepper(settings), model, start, step);
    // Four seeds sample the floor; three times their largest leaves room for the tail. An error in a row
    // would show at 1e-3 m/s and more, so 1e-5 m/s is accepted where the seeds happen to agree.
    EXPECT_LT(largest_speed_difference(reference, own), 3 * floor + 1e-5) << "at step " << step;
    advance(*path, 1);
    steps_with_impact += path->observables(0).islands < 3 ? 1 : 0;
  }
  EXPECT_GT(steps_with_impact, 5) << "the car must have hit a ragdoll";
}

TEST(SorStepper, counts_rows_and_islands_as_the_ode_backend_does) {
  const model::Model model = support::crash();
  const auto own = make_stepper(sor_settings(), {model});
  const auto ode = quick(sor_settings(), {model});
  advance(*own, 1);
  advance(*ode, 1);
  EXPECT_EQ(own->observables(0).rows, ode->observables(0).rows);
  EXPECT_EQ(own->observables(0).islands, ode->observables(0).islands);
  EXPECT_EQ(own->observables(0).max_island_rows, ode->observables(0).max_island_rows);
}

TEST(SorStepper, substeps_hold_joints_better_than_iterations) {
  stepping::StepperSettings iterations = sor_settings(), substeps = sor_settings();
  substeps.substeps = 5;
  substeps.iterations = 3;
  const auto coarse = make_stepper(iterations, {support::chain(12)});
  const auto fine = make_stepper(substeps, {support::chain(12)});
  double coarse_gap = 0, fine_gap = 0;
  for (int step = 0; step < 100; ++step) {
    advance(*coarse, 1);
    advance(*fine, 1);
    coarse_gap = std::max(coarse_gap, coarse->observables(0).joint_gap_m);
    fine_gap = std::max(fine_gap, fine->observables(0).joint_gap_m);
  }
  EXPECT_LT(3 * fine_gap, coarse_gap) << "15 sweeps in 5 substeps against 20 in one";
}

TEST(SorStepper, settings_that_make_no_sense_are_refused) {
  for (const auto& spoil : std::vector<void (*)(stepping::StepperSettings&)>{
           [](stepping::StepperSettings& s) { s.dt_s = 0; },
           [](stepping::StepperSettings& s) { s.iterations = 0; },
           [](stepping::StepperSettings& s) { s.substeps = 0; },
           [](stepping::StepperSettings& s) { s.law.warm_start = 1.1; },
           [](stepping::StepperSettings& s) { s.law.warm_start = -0.1; }}) {
    stepping::StepperSettings settings = sor_settings();
    spoil(settings);
    EXPECT_THROW(make_stepper(settings), core::InputError);
  }
}

}  // namespace
}  // namespace pbmpi::solver
