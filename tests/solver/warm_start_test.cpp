/// Impulses that carry over from substep to substep, and forces that carry over from step to step.
#include <gtest/gtest.h>

#include <algorithm>

#include "solver/sor_run.h"
#include "stepping/step_options.h"
#include "support/models.h"

namespace pbmpi::solver {
namespace {

stepping::StepperSettings settings_of(int substeps, int iterations, double warm_start) {
  stepping::StepperSettings settings = default_settings(stepping::StepperKind::sor, stepping::Law::ode);
  settings.substeps = substeps;
  settings.iterations = iterations;
  settings.law.warm_start = warm_start;
  return settings;
}

std::vector<std::uint64_t> hashes_after(const stepping::StepperSettings& settings,
                                        const std::vector<model::Model>& worlds, int num_steps) {
  const auto stepper = make_stepper(settings, worlds);
  advance(*stepper, num_steps);
  std::vector<std::uint64_t> hashes;
  for (std::size_t i = 0; i < worlds.size(); ++i)
    hashes.push_back(model::hash(stepper->state(static_cast<int>(i))));
  return hashes;
}

/// Worlds some of which fall into a pile and some crash, and no two of which have the same contacts.
std::vector<model::Model> worlds() {
  std::vector<model::Model> models;
  for (int variant = 0; variant < 5; ++variant) models.push_back(support::crash(variant));
  for (int boxes = 2; boxes < 5; ++boxes) models.push_back(support::pile(boxes));
  return models;
}

TEST(WarmStart, gives_the_same_bits_for_every_width_and_for_a_world_alone) {
  for (const stepping::Precision precision : {stepping::Precision::double_, stepping::Precision::single}) {
    stepping::StepperSettings settings = settings_of(5, 3, 0.9);
    settings.precision = precision;
    settings.simd = stepping::Simd::off;
    const std::vector<std::uint64_t> expected = hashes_after(settings, worlds(), 24);
    for (const stepping::Simd simd : machine_simds()) {
      settings.simd = simd;
      EXPECT_EQ(hashes_after(settings, worlds(), 24), expected) << static_cast<int>(simd);
      EXPECT_EQ(hashes_after(settings, {worlds()[3]}, 24).front(), expected[3]) << static_cast<int>(simd);
    }
    settings.law.warm_start = 0;
    EXPECT_NE(hashes_after(settings, worlds(), 24), expected);
  }
}

/// The hash after one step from the state after 20; without its memory if `forgets`.
std::uint64_t hash_one_step_later(double warm_start, bool forgets) {
  const model::Model model = support::crash();
  const auto before = make_stepper(settings_of(1, 10, 0.9), {model});
  advance(*before, 20);
  model::State state = before->state(0);
  EXPECT_FALSE(state.memory.contacts.empty());
  EXPECT_EQ(state.memory.joints.size(), model.joints.size());
  if (forgets) state.memory.clear();
  const auto stepper = make_stepper(settings_of(1, 10, warm_start));
  stepper->add(0, std::make_shared<const model::Model>(model), state, 20);
  advance(*stepper, 1);
  return model::hash(stepper->state(0));
}

TEST(WarmStart, reaches_from_step_to_step_and_without_it_the_memory_has_no_effect) {
  EXPECT_NE(hash_one_step_later(0.9, false), hash_one_step_later(0.9, true)) << "of one substep, too";
  EXPECT_EQ(hash_one_step_later(0, false), hash_one_step_later(0, true));
}

TEST(WarmStart, of_nothing_leaves_nothing_to_remember) {
  const auto stepper = make_stepper(settings_of(5, 3, 0), {support::crash()});
  advance(*stepper, 20);
  EXPECT_TRUE(stepper->state(0).memory.empty());
}

TEST(WarmStart, a_state_that_is_set_again_goes_on_with_the_same_bits) {
  const stepping::StepperSettings settings = default_settings(stepping::StepperKind::sor);
  const auto straight = make_stepper(settings, worlds()), again = make_stepper(settings, worlds());
  for (int step = 0; step < 24; ++step) {
    advance(*straight, 1);
    advance(*again, 1);
    for (int world = 0; world < 8; ++world) {
      const model::State state = again->state(world);
      again->set_state(world, state, step + 1);
      EXPECT_EQ(model::hash(again->state(world)), model::hash(straight->state(world))) << "step " << step;
    }
  }
}

TEST(WarmStart, the_step_depends_on_the_state_alone) {
  const stepping::StepperSettings settings = settings_of(5, 3, 0.9);
  const model::Model model = support::crash();
  const auto straight = make_stepper(settings, {model}), stepper = make_stepper(settings, {model});
  advance(*straight, 20);
  advance(*stepper, 12);
  const auto resumed = make_stepper(settings);
  resumed->add(0, std::make_shared<const model::Model>(model), stepper->state(0), 12);
  advance(*resumed, 8);
  EXPECT_EQ(model::hash(resumed->state(0)), model::hash(straight->state(0)));
}

/// Mean over 200 steps of the largest joint gap [m] of a chain that hangs at rest.
double gap_at_rest(double warm_start) {
  model::Model chain = support::chain(12);  // stretched along x
  chain.gravity = {9.81, 0, 0};
  const auto stepper = make_stepper(settings_of(5, 3, warm_start), {chain});
  double sum_m = 0;
  for (int step = 0; step < 200; ++step) {
    advance(*stepper, 1);
    sum_m += stepper->observables(0).joint_gap_m;
  }
  return sum_m / 200;
}

TEST(WarmStart, holds_what_rests_better) {
  const double cold_m = gap_at_rest(0), warm_m = gap_at_rest(0.9);
  EXPECT_GT(cold_m, 1e-4) << "15 sweeps from nothing leave a chain of 12 links stretched";
  EXPECT_LT(2 * warm_m, cold_m) << "four of five substeps start near their impulses";
}

TEST(WarmStart, a_box_rests_without_being_pulled_or_thrown) {
  const auto stepper = make_stepper(settings_of(4, 4, 0.9), {support::box_over_ground(0.01)});
  advance(*stepper, 200);
  EXPECT_LT(stepper->state(0).velocity[0].norm(), 1e-3) << "two seconds are enough to come to rest [m/s]";
  EXPECT_NEAR(stepper->state(0).position[0].z(), 0.5, 1e-3);
}

/// Crashes in which the joints of some ragdolls hold their pose, between limits, and those of others do not.
std::vector<model::Model> holders() {
  std::vector<model::Model> models;
  for (int variant = 0; variant < 6; ++variant) {
    models.push_back(support::crash(variant));
    if (variant % 3 == 0) continue;
    for (model::Joint& joint : models.back().joints) {
      if (joint.kind != model::JointKind::hinge && joint.kind != model::JointKind::universal) continue;
      joint.motors[0] = {0, 30, 20};
      joint.limits[0] = {-0.05 * variant, 0.02};
    }
  }
  return models;
}

TEST(Substeps, go_by_a_held_angle_in_its_own_lane_only) {
  for (const stepping::Precision precision : {stepping::Precision::double_, stepping::Precision::single}) {
    stepping::StepperSettings settings = settings_of(4, 4, 0.5);
    settings.precision = precision;
    settings.simd = stepping::Simd::off;
    const std::vector<std::uint64_t> expected = hashes_after(settings, holders(), 20);
    for (const stepping::Simd simd : machine_simds()) {
      settings.simd = simd;
      EXPECT_EQ(hashes_after(settings, holders(), 20), expected) << static_cast<int>(simd);
      for (const std::size_t alone : {2, 3})
        EXPECT_EQ(hashes_after(settings, {holders()[alone]}, 20).front(), expected[alone]);
    }
  }
}

TEST(Substeps, hold_a_pose_as_small_steps_do) {
  model::Model swings = support::pendulum(1, 0.5);
  swings.joints[0].motors[0] = {0, 15, 3};  // back towards its initial angle
  swings.joints[0].limits[0] = {-0.4, 0.3};
  swings.bodies[0].velocity = {4, 0, 0};
  stepping::StepperSettings small = settings_of(1, 400, 0), substeps = settings_of(5, 400, 0);
  small.dt_s = substeps.dt_s / 5;
  const auto fine = make_stepper(small, {swings}), coarse = make_stepper(substeps, {swings});
  double farthest_m = 0;
  for (int step = 0; step < 60; ++step) {
    advance(*fine, 5);
    advance(*coarse, 1);
    const model::Vec3 moved = fine->state(0).position[0] - swings.bodies[0].pose.position;
    farthest_m = std::max(farthest_m, moved.norm());
    // Angles are advanced over four substeps of 2 ms: an error of second order in them.
    EXPECT_LT((coarse->state(0).position[0] - fine->state(0).position[0]).norm(), 2e-4) << step;
  }
  EXPECT_GT(farthest_m, 0.01);
}

TEST(RowOrder, fixed_and_shuffled_orders_agree_once_converged) {
  stepping::StepperSettings settings = settings_of(1, 4000, 0);
  const auto shuffled = make_stepper(settings, {support::chain(6)});
  settings.law.row_order = stepping::RowOrder::fixed;
  const auto fixed = make_stepper(settings, {support::chain(6)});
  advance(*shuffled, 1);
  advance(*fixed, 1);
  double largest = 0;
  for (int body = 0; body < 6; ++body)
    largest = std::max(largest, (shuffled->state(0).velocity[static_cast<std::size_t>(body)] -
                                 fixed->state(0).velocity[static_cast<std::size_t>(body)])
                                    .norm());
  // One solution, reached up to a thousand roundings of speeds of about 1 m/s.
  EXPECT_LT(largest, 1e-12);
  settings.iterations = 4;
  EXPECT_NE(hashes_after(settings, {support::chain(6)}, 1),
            hashes_after(settings_of(1, 4, 0), {support::chain(6)}, 1));
}

}  // namespace
}  // namespace pbmpi::solver
