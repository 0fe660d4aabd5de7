#include "stability/energy_gain.h"

#include <gtest/gtest.h>

#include <functional>
#include <memory>

#include "model/mechanics.h"
#include "ode/collide/narrow_phase.h"
#include "solver/worlds/sor_stepper.h"
#include "stepping/stepper_traits.h"
#include "support/models.h"

namespace pbmpi::stability {
namespace {

using model::Model;
using model::State;
using model::Vec3;

constexpr double ball_radius_m = 0.2;

/// A ball of 1 kg without ground.
Model one_ball() {
  Model model;
  const int actor = support::add_actor(model, "ball");
  support::add_solid(model, actor, "ball", model::Shape::sphere, {ball_radius_m}, 1, {0, 0, 2});
  return model;
}

/// Called with the state after each step; may change it.
using Change = std::function<void(std::int64_t step, State& state)>;

/// The energy that a world gains over some steps, checked every `steps_a_frame` steps.
double gain_of(const Model& model, int num_steps, int steps_a_frame = 1, const Change& change = {}) {
  const stepping::StepperSettings settings = default_settings(stepping::StepperKind::sor, stepping::Law::ode);
  const auto stepper = solver::make_sor_stepper(settings, ode::make_narrow_phase);
  State before = initial_state(model);
  stepper->add(0, std::make_shared<const Model>(model), before, 0);
  const EnergyGain gain(model, settings.dt_s);
  model::GuardMemory memory;
  core::PhaseTimes times;
  for (int step = 0; step < num_steps; step += steps_a_frame) {
    stepper->advance(steps_a_frame, times);
    State after = stepper->state(0);
    if (change) {
      change(step, after);
      stepper->set_state(0, after, step + steps_a_frame);
    }
    gain.add({before, mechanical_energy(model, before)}, {after, mechanical_energy(model, after)}, step,
             steps_a_frame, memory);
    before = after;
  }
  return memory.energy_gain_j;
}

TEST(EnergyGain, of_a_free_fall_is_nothing) { EXPECT_LT(gain_of(one_ball(), 100), 1e-9); }

TEST(EnergyGain, of_an_elastic_bounce_is_little) {
  Model model = one_ball();
  support::add_ground(model);
  for (model::Geom& geom : model.geoms) geom.material.restitution = 1;
  // A bounce is seen at the end of a step: at most g dt v of potential energy, half a joule out of 18.
  EXPECT_LT(gain_of(model, 400), 0.5);
}

TEST(EnergyGain, sees_a_velocity_that_grows_without_a_cause) {
  const double gain = gain_of(one_ball(), 20, 1, [](std::int64_t step, State& state) {
    if (step == 10) state.velocity[0] *= 2;
  });
  const double speed = 11 * 9.81 * 0.01;
  // Each step of a free fall loses m (g dt)^2 / 2, 5 mJ, by itself.
  EXPECT_NEAR(gain, 0.5 * (4 - 1) * speed * speed, 0.05);
}

TEST(EnergyGain, is_not_paid_for_by_energy_lost_before) {
  const double gain = gain_of(one_ball(), 40, 1, [](std::int64_t step, State& state) {
    if (step == 10) state.position[0].z() -= 100;
    if (step == 30) state.position[0].z() += 1;
  });
  EXPECT_NEAR(gain, 9.81, 0.1);
}

/// A rod that a motor turns about the world's z axis.
Model driven_rod(double max_force) {
  Model model;
  model.gravity.setZero();
  const int actor = support::add_actor(model, "rod");
  const int rod = support::add_solid(model, actor, "rod", model::Shape::box, {1, 0.1, 0.1}, 3, {0, 0, 0});
  const int hinge = support::add_joint(model, model::JointKind::hinge, rod, model::no_body, {0, 0, 0});
  model.joints[static_cast<std::size_t>(hinge)].motors[0] = {.velocity = 5, .max_force = max_force};
  return model;
}

TEST(EnergyGain, counts_what_a_motor_delivers_as_caused) {
  EXPECT_LT(gain_of(driven_rod(2), 50), 1e-9);
  EXPECT_LT(gain_of(driven_rod(2), 50, 10), 1e-9);
  EXPECT_LT(gain_of(driven_rod(1e3), 50), 1e-9);
}

TEST(EnergyGain, counts_a_motor_from_the_event_on_that_starts_it) {
  Model model = driven_rod(0);
  model::Event start;
  start.step = 7;
  start.kind = model::EventKind::motor;
  start.joint = 0;
  start.motor = {.velocity = -5, .max_force = 2};
  model.events = {start};
  EXPECT_LT(gain_of(model, 50, 5), 1e-9);
  // Before the event nothing drives the rod.
  EXPECT_GT(gain_of(model, 6, 1,
                    [](std::int64_t step, State& state) {
                      if (step == 3) state.angular_velocity[0].z() = 5;
                    }),
            3);
}

TEST(EnergyGain, counts_a_launch_as_caused) {
  Model model = one_ball();
  model::Event launch;
  launch.step = 8;
  launch.body = 0;
  launch.velocity = Vec3(30, 0, 20);
  launch.pose = model::Pose{{0, 0, 50}, {}};
  model.events = {launch};
  for (const int steps_a_frame : {1, 4, 5}) {
    // Checked across a frame, the ball may have lost its speed before the launch.
    EXPECT_LT(gain_of(model, 20, steps_a_frame), 1e-9) << steps_a_frame;
  }
}

/// A box that moves towards a heavy wheel on a spring in free space: it oscillates.
Model sprung_box() {
  Model model;
  const int actor = support::add_actor(model, "car");
  const int box = support::add_solid(model, actor, "box", model::Shape::box, {1, 1, 1}, 10, {0, 0, 2});
  const int wheel = support::add_solid(model, actor, "wheel", model::Shape::sphere, {0.2}, 1e6, {0, 0, 1.2});
  model.gravity.setZero();
  const int joint = support::add_joint(model, model::JointKind::hinge2, box, wheel, {0, 0, 1.2},
                                       Vec3::UnitZ(), Vec3::UnitY());
  model.joints[static_cast<std::size_t>(joint)].suspension = {1000, 0};
  model.bodies[0].velocity.z() = -2;
  return model;
}

TEST(EnergyGain, counts_what_a_suspension_stores_and_releases) {
  const Model model = sprung_box();
  State state = initial_state(model);
  EXPECT_EQ(spring_energy(model, state), 0);
  state.position[0].z() -= 0.1;
  EXPECT_NEAR(spring_energy(model, state), 0.5 * 1000 * 0.1 * 0.1, 1e-12);
  EXPECT_LT(gain_of(model, 200), 0.05 * 20);
  // Ten steps are less than a quarter of a period: the spring returns its energy over several frames.
  EXPECT_LT(gain_of(model, 200, 5), 0.05 * 20);
}

TEST(AllowedWork, of_a_launch_that_takes_energy_is_negative) {
  Model model = one_ball();
  model.bodies[0].velocity = Vec3(10, 0, 0);
  model::Event stop;
  stop.step = 3;
  stop.body = 0;
  model.events = {stop};
  const State state = initial_state(model);
  EXPECT_NEAR(allowed_work(model, state, state, 3, 1, 0.01), -50, 1e-9);
  EXPECT_EQ(allowed_work(model, state, state, 4, 1, 0.01), 0);
}

TEST(AllowedWork, of_a_joint_that_is_broken_is_nothing) {
  const Model model = driven_rod(2);
  State state = initial_state(model);
  EXPECT_NEAR(allowed_work(model, state, state, 0, 10, 0.01), 2 * 5 * 0.1, 1e-12);
  state.broken_in = {0};
  EXPECT_EQ(allowed_work(model, state, state, 0, 10, 0.01), 0);
}

TEST(AllowedWork, of_a_motor_follows_its_events) {
  Model model = driven_rod(2);
  model::Event stronger, off;
  stronger.kind = off.kind = model::EventKind::motor;
  stronger.joint = off.joint = 0;
  stronger.step = 4;
  stronger.motor = {.velocity = 5, .max_force = 3};
  off.step = 8;
  model.events = {stronger, off};
  const State state = initial_state(model);
  const auto work = [&](std::int64_t first_step) {
    return allowed_work(model, state, state, first_step, 2, 0.01);
  };
  EXPECT_NEAR(work(2), 2 * 5 * 0.02, 1e-12) << "before the event";
  EXPECT_NEAR(work(3), 3 * 5 * 0.02, 1e-12) << "the stronger of both counts";
  EXPECT_NEAR(work(4), 3 * 5 * 0.02, 1e-12);
  EXPECT_EQ(work(8), 0);
}

TEST(AllowedWork, of_a_steered_axis_is_that_of_its_lighter_body_at_its_speed) {
  Model model = sprung_box();
  model::Event steer;
  steer.kind = model::EventKind::steer;
  steer.joint = 0;
  steer.step = 5;
  steer.angle = 0.1;
  model.events = {steer};
  const State state = initial_state(model);
  const double lighter = 10 * (1 + 1) / 12.0;  // the box, about any axis
  EXPECT_EQ(allowed_work(model, state, state, 4, 1, 0.01), 0);
  EXPECT_NEAR(allowed_work(model, state, state, 5, 1, 0.01), 0.5 * lighter * 10 * 10, 1e-9);
  EXPECT_EQ(allowed_work(model, state, state, 6, 1, 0.01), 0) << "the angle is reached, and held";
}

}  // namespace
}  // namespace pbmpi::stability
