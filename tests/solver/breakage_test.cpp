// The effect "breakable_joints" in all steppers: quick, direct and sor. (Long because every kind of joint
// breaks, and is released, in each of them with the same helpers.)
#include "effects/breakage.h"

#include <gtest/gtest.h>

#include <ostream>

#include "model/names.h"
#include "ode/ode_stepper.h"
#include "solver/sor_run.h"
#include "stepping/step_options.h"
#include "support/models.h"

namespace pbmpi::solver {
namespace {

using model::JointKind;
using model::Model;
using model::State;
using model::Vec3;
using stepping::StepperKind;
using stepping::StepperSettings;

constexpr double gravity = 9.81;
constexpr double mass_kg = 12;
constexpr double arm_m = 0.5;

struct Stepped {
  std::string name;
  StepperSettings settings;
};
std::ostream& operator<<(std::ostream& out, const Stepped& by) { return out << by.name; }

/// Enough iterations to give the load of two joints in a row to a tenth of the percent by which the tests
/// exceed it.
std::vector<Stepped> all_steppers() {
  const StepperSettings direct = default_settings(StepperKind::direct);
  StepperSettings quick = default_settings(StepperKind::quick);
  StepperSettings sor = default_settings(StepperKind::sor, stepping::Law::ode);
  quick.iterations = sor.iterations = 400;
  StepperSettings single = sor, substeps = sor;
  single.precision = stepping::Precision::single;
  substeps.substeps = 4;
  return {{"quick", quick}, {"direct", direct}, {"sor", sor}, {"single", single}, {"substeps", substeps}};
}

std::unique_ptr<stepping::WorldStepper> start(const StepperSettings& settings, const Model& model,
                                              const State& state, std::int64_t step = 0) {
  auto stepper = settings.kind == StepperKind::sor
                     ? make_stepper(settings)
                     : ode::make_ode_stepper(settings, [](const std::string&) {});
  stepper->add(0, std::make_shared<const Model>(model), state, step);
  return stepper;
}

State state_after(const StepperSettings& settings, const Model& model, int num_steps) {
  const auto stepper = start(settings, model, model::initial_state(model));
  advance(*stepper, num_steps);
  return stepper->state(0);
}

/// A base that is fixed to the world, and a box next to it at the end of an arm, held by a joint of this kind
/// midway: index 1. The axes are chosen so that the joint alone carries the box's weight and moment.
Model cantilever(JointKind kind) {
  Model model;
  const int actor = support::add_actor(model, "boxes", model::ActorKind::prop, true);
  const int base =
      support::add_solid(model, actor, "base", model::Shape::box, {0.3, 0.3, 0.3}, mass_kg, {0, 0, 2});
  const int box =
      support::add_solid(model, actor, "box", model::Shape::box, {0.4, 0.4, 0.4}, mass_kg, {2 * arm_m, 0, 2});
  support::add_joint(model, JointKind::fixed, base, model::no_body, {0, 0, 2});
  const Vec3 axis1 = kind == JointKind::slider ? Vec3::UnitY() : Vec3::UnitZ();
  support::add_joint(model, kind, base, box, {arm_m, 0, 2}, axis1, Vec3::UnitX());
  return model;
}

/// The box hangs directly below its joint.
Model hanging(JointKind kind) {
  Model model = cantilever(kind);
  model.bodies[1].pose.position = {0, 0, 2 - 2 * arm_m};
  model.joints.pop_back();
  support::add_joint(model, kind, 0, 1, {0, 0, 2 - arm_m}, Vec3::UnitY(), Vec3::UnitX());
  return model;
}

/// Half a second: the box is at rest, so no later step loads the joint differently.
constexpr int num_steps = 50;

class EveryStepperAndKind : public testing::TestWithParam<std::tuple<Stepped, JointKind>> {
 protected:
  const StepperSettings& settings() const { return std::get<0>(GetParam()).settings; }
  JointKind kind() const { return std::get<1>(GetParam()); }
};

TEST_P(EveryStepperAndKind, breaks_a_hung_joint_below_the_weight_and_not_above_it) {
  Model model = hanging(kind());
  model.joints[1].break_force = 1.01 * mass_kg * gravity;
  EXPECT_FALSE(state_after(settings(), model, num_steps).is_broken(1));
  model.joints[1].break_force = 0.99 * mass_kg * gravity;
  EXPECT_EQ(state_after(settings(), model, num_steps).broken_in[1], 0);
}

/// With a memory a joint is a spring, whose load first overshoots the final weight by up to a tenth, and the
/// moment of an arm by up to a half; at rest the load is that of the weight.
TEST(RememberingStep, breaks_a_joint_that_has_come_to_rest_below_the_weight_and_not_above_it) {
  const StepperSettings settings = default_settings(StepperKind::sor);
  for (const JointKind kind : {JointKind::ball, JointKind::hinge, JointKind::slider, JointKind::universal,
                               JointKind::fixed, JointKind::hinge2}) {
    Model model = hanging(kind);
    model.joints[1].break_force = 10 * mass_kg * gravity;
    const State at_rest = state_after(settings, model, num_steps);
    ASSERT_FALSE(at_rest.is_broken(1)) << name_of(kind);
    for (const bool breaks : {false, true}) {
      model.joints[1].break_force = (breaks ? 0.99 : 1.01) * mass_kg * gravity;
      const auto stepper = start(settings, model, at_rest, num_steps);
      advance(*stepper, num_steps);
      EXPECT_EQ(stepper->state(0).is_broken(1), breaks) << name_of(kind);
    }
  }
}

TEST_P(EveryStepperAndKind, breaks_an_arm_below_its_moment_and_not_above_it) {
  if (kind() == JointKind::ball) GTEST_SKIP() << "bears no moment";
  Model model = cantilever(kind());
  model.joints[1].break_torque = 1.01 * mass_kg * gravity * arm_m;
  EXPECT_FALSE(state_after(settings(), model, num_steps).is_broken(1));
  model.joints[1].break_torque = 0.99 * mass_kg * gravity * arm_m;
  EXPECT_EQ(state_after(settings(), model, num_steps).broken_in[1], 0);
}

// The base's joint to the world carries both weights; the base's own weight acts below it.
TEST_P(EveryStepperAndKind, breaks_a_joint_to_the_world_alike) {
  if (kind() == JointKind::hinge2) GTEST_SKIP() << "needs two bodies";
  Model model;
  const int actor = support::add_actor(model, "box");
  const int box =
      support::add_solid(model, actor, "box", model::Shape::box, {0.4, 0.4, 0.4}, mass_kg, {3, 1, 2});
  support::add_joint(model, kind(), box, model::no_body, {3, 1, 2.5}, Vec3::UnitY(), Vec3::UnitX());
  model.joints[0].break_torque = 0.01 * mass_kg * gravity * arm_m;  // nothing turns it
  model.joints[0].break_force = 1.01 * mass_kg * gravity;
  EXPECT_FALSE(state_after(settings(), model, num_steps).is_broken(0));
  model.joints[0].break_force = 0.99 * mass_kg * gravity;
  EXPECT_EQ(state_after(settings(), model, num_steps).broken_in[0], 0);
}

TEST_P(EveryStepperAndKind, lets_a_broken_joint_act_no_more) {
  Model model = hanging(kind());
  const bool has_axis = kind() != JointKind::ball && kind() != JointKind::fixed;
  if (has_axis) {
    model.joints[1].motors[0] = {3, 500};
    model.joints[1].limits[0] = {-0.1, 0.1};
  }
  model.joints[1].break_force = 1;
  const auto stepper = start(settings(), model, model::initial_state(model));
  advance(*stepper, 1);
  const State held = stepper->state(0);
  ASSERT_EQ(held.broken_in[1], 0) << "a motor of 500 N m or N, or the weight, loads it above 1 N";
  advance(*stepper, 10);
  const State& state = stepper->state(0);
  const Vec3 expected = held.velocity[1] + Vec3(0, 0, -10 * 0.01 * gravity);
  // Ten sums in single precision of numbers of size 1: 1e-6.
  EXPECT_LT((state.velocity[1] - expected).norm(), 1e-5);
  EXPECT_LT((state.angular_velocity[1] - held.angular_velocity[1]).norm(), 1e-5) << "a cube: no precession";
  EXPECT_EQ(stepper->observables(0).islands, 2);
  EXPECT_EQ(stepper->observables(0).rows, 6) << "those of the base's joint";
}

INSTANTIATE_TEST_SUITE_P(Joints, EveryStepperAndKind,
                         testing::Combine(testing::ValuesIn(all_steppers()),
                                          testing::Values(JointKind::ball, JointKind::hinge,
                                                          JointKind::slider, JointKind::universal,
                                                          JointKind::fixed, JointKind::hinge2)),
                         [](const auto& test) {
                           return std::get<0>(test.param).name + "_" +
                                  std::string(name_of(std::get<1>(test.param)));
                         });

class EveryStepper : public testing::TestWithParam<Stepped> {
 protected:
  const StepperSettings& settings() const { return GetParam().settings; }
};

/// A pendulum of two boxes whose upper joint (0) breaks as they swing through, above the ground; the lower
/// box's joint has a motor. `weaker` changes the step in which it breaks.
Model swing(double strength_n) {
  Model model;
  support::add_ground(model);
  const int actor = support::add_actor(model, "boxes", model::ActorKind::prop, true);
  for (const int i : {0, 1}) {
    support::add_solid(model, actor, "box" + std::to_string(i), model::Shape::box, {0.4, 0.3, 0.3}, 5,
                       {0.5 + 0.6 * i, 0, 3});
  }
  support::add_joint(model, JointKind::hinge, 0, model::no_body, {0, 0, 3}, Vec3::UnitY());
  support::add_joint(model, JointKind::hinge, 0, 1, {0.8, 0, 3}, Vec3::UnitY());
  model.joints[1].motors[0] = {0, 4, 5};
  model.joints[0].break_force = strength_n;
  return model;
}
constexpr double swing_strength_n = 170;
constexpr int swing_steps = 120;  // it breaks after about half of them, and hits the ground

TEST_P(EveryStepper, goes_on_with_the_same_bits_wherever_the_state_is_taken_in) {
  const Model model = swing(swing_strength_n);
  const auto through = start(settings(), model, model::initial_state(model));
  advance(*through, swing_steps);
  const State end = through->state(0);
  ASSERT_TRUE(end.is_broken(0));
  const int broke = end.broken_in[0];
  ASSERT_GT(broke, 10);
  ASSERT_LT(broke, swing_steps - 20);
  for (const int step : {broke - 1, broke, broke + 1, broke + 2, swing_steps - 5}) {
    const State middle = state_after(settings(), model, step);
    const auto second = start(settings(), model, middle, step);
    advance(*second, swing_steps - step);
    EXPECT_EQ(model::hash(second->state(0)), model::hash(end)) << "at step " << step << " of " << broke;
  }
}

/// `model` with joint 0 released at this step.
Model released(Model model, std::int64_t step) {
  model::Event event;
  event.kind = model::EventKind::release;
  event.step = step;
  event.joint = 0;
  model.events.push_back(event);
  return model;
}

TEST_P(EveryStepper, holds_a_joint_until_it_is_released_and_no_longer) {
  constexpr int release_step = 7;
  Model model = hanging(JointKind::hinge);
  std::swap(model.joints[0], model.joints[1]);
  const auto stepper = start(settings(), released(model, release_step), model::initial_state(model));
  advance(*stepper, release_step);
  const State held = stepper->state(0);
  EXPECT_LT(held.velocity[1].norm(), 1e-3) << "400 iterations hold its weight";
  EXPECT_EQ(held.broken_in[0], release_step - 1);
  EXPECT_EQ(stepper->observables(0).rows, 6 + 5) << "it acted in its last step";
  advance(*stepper, 10);
  const State& state = stepper->state(0);
  const Vec3 expected = held.velocity[1] + Vec3(0, 0, -10 * 0.01 * gravity);
  EXPECT_LT((state.velocity[1] - expected).norm(), 1e-5);  // single precision: ten sums of numbers of size 1
  EXPECT_EQ(stepper->observables(0).rows, 6) << "those of the base's joint";
}

TEST_P(EveryStepper, goes_on_with_the_same_bits_wherever_the_state_is_taken_in_around_a_release) {
  const Model model = released(swing(0), 40);
  const State end = state_after(settings(), model, swing_steps);
  EXPECT_EQ(end.broken_in[0], 39);
  for (const int step : {38, 39, 40, 41}) {
    const auto second = start(settings(), model, state_after(settings(), model, step), step);
    advance(*second, swing_steps - step);
    EXPECT_EQ(model::hash(second->state(0)), model::hash(end)) << "at step " << step;
  }
}

TEST_P(EveryStepper, wakes_what_is_released) {
  Model model = hanging(JointKind::hinge);
  std::swap(model.joints[0], model.joints[1]);
  model = released(model, 200);
  model.effects["sleeping"] = true;
  const auto stepper = start(settings(), model, model::initial_state(model));
  advance(*stepper, 199);
  ASSERT_TRUE(stepper->state(0).rest[1].asleep());
  advance(*stepper, 2);
  EXPECT_EQ(stepper->state(0).broken_in[0], 199);
  EXPECT_LT(stepper->state(0).velocity[1].z(), -0.9 * 0.01 * gravity) << "it falls in step 200";
}

TEST_P(EveryStepper, mends_what_an_earlier_state_has_whole) {
  const Model model = swing(swing_strength_n);
  const auto stepper = start(settings(), model, model::initial_state(model));
  advance(*stepper, swing_steps);
  const State end = stepper->state(0);
  ASSERT_TRUE(end.is_broken(0));
  stepper->set_state(0, model::initial_state(model), 0);
  EXPECT_FALSE(stepper->state(0).is_broken(0));
  advance(*stepper, swing_steps);
  EXPECT_EQ(model::hash(stepper->state(0)), model::hash(end));
}

TEST_P(EveryStepper, keeps_what_is_broken_where_the_effect_is_left_out) {
  Model model = swing(swing_strength_n);
  const State end = state_after(settings(), model, swing_steps);
  ASSERT_TRUE(end.is_broken(0));
  const auto with = start(settings(), model, end, swing_steps);
  model.joints[0].break_force = 0;
  const auto without = start(settings(), model, end, swing_steps);
  advance(*with, 20);
  advance(*without, 20);
  EXPECT_EQ(model::hash(without->state(0)), model::hash(with->state(0)));
}

TEST_P(EveryStepper, lets_the_bodies_of_a_broken_joint_touch_again) {
  Model model = cantilever(JointKind::ball);
  model.joints.pop_back();
  model.bodies[1].pose.position = {0, 0, 2.36};  // 1 cm above the base
  support::add_joint(model, JointKind::ball, 0, 1, {0, 0, 2.2});
  const State held = state_after(settings(), model, num_steps);
  model.joints[1].break_force = 0.5 * mass_kg * gravity;
  const auto stepper = start(settings(), model, model::initial_state(model));
  advance(*stepper, num_steps);
  EXPECT_TRUE(stepper->state(0).is_broken(1));
  EXPECT_GT(stepper->observables(0).contacts, 0);
  // It lies on the base, whose top is 0.35 m below its centre; a contact supports it to within 1 mm.
  EXPECT_NEAR(stepper->state(0).position[1].z(), 2.35, 1e-3);
  EXPECT_NEAR(held.position[1].z(), 2.36, 1e-3);
}

TEST_P(EveryStepper, asks_for_no_pass_without_a_strength) {
  const Model model = swing(0);
  EXPECT_TRUE(state_after(settings(), model, 3).broken_in.empty());
}

TEST_P(EveryStepper, lets_broken_parts_sleep_apart) {
  Model model = swing(swing_strength_n);
  model.effects["sleeping"] = true;
  const State end = state_after(settings(), model, 600);
  ASSERT_TRUE(end.is_broken(0));
  EXPECT_TRUE(end.rest[0].asleep() && end.rest[1].asleep()) << "they lie on the ground";
}

INSTANTIATE_TEST_SUITE_P(All, EveryStepper, testing::ValuesIn(all_steppers()),
                         [](const auto& test) { return test.param.name; });

// Worlds in one pack that break at different steps, one not at all.
TEST(Breakage, in_a_lane_leaves_its_neighbours_as_they_are) {
  for (const stepping::Precision precision : {stepping::Precision::double_, stepping::Precision::single}) {
    StepperSettings settings = default_settings(StepperKind::sor, stepping::Law::ode);
    settings.precision = precision;
    std::vector<Model> worlds;
    std::vector<std::uint64_t> alone;
    for (const double strength : {1e6, 160.0, 120.0, 0.0, 170.0}) {
      worlds.push_back(swing(strength));
      alone.push_back(model::hash(state_after(settings, worlds.back(), swing_steps)));
    }
    for (const stepping::Simd simd : machine_simds()) {
      settings.simd = simd;
      const auto together = make_stepper(settings, worlds);
      advance(*together, swing_steps);
      EXPECT_FALSE(together->state(0).is_broken(0));
      EXPECT_NE(together->state(1).broken_in[0], together->state(2).broken_in[0]);
      for (std::size_t world = 0; world < worlds.size(); ++world)
        EXPECT_EQ(model::hash(together->state(static_cast<int>(world))), alone[world]) << world;
    }
  }
}

// A broken joint has no rows, and therefore no residual.
TEST(Breakage, leaves_no_residual) {
  StepperSettings settings = default_settings(StepperKind::sor, stepping::Law::ode);
  settings.residuals = true;
  Model model = hanging(JointKind::hinge);
  model.joints[1].break_force = 1;
  const auto stepper = start(settings, model, model::initial_state(model));
  advance(*stepper, 20);
  const stepping::Residuals& seen = stepper->observables(0).residuals;
  // [m/s] residual of the base's joint alone, which 20 iterations solve; the broken joint's rows would be off
  // by 2 m/s
  EXPECT_LT(seen.joint_speed, 1e-3);
  EXPECT_LT(seen.natural_speed, 1e-3);
}

}  // namespace
}  // namespace pbmpi::solver
