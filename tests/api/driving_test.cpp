/// Forces and efforts from outside, and where joints are.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <stdexcept>
#include <string>
#include <tuple>
#include <vector>

#include "pbmpi/batch.h"

namespace pbmpi::test {
namespace {

/// Without gravity: a rod of 2 kg and 1 m on a hinge about z at its end, a rod on it, by a universal joint, a
/// slider along y, and a free ball.
constexpr const char* jointed_scene = R"(
title = "a rod, a slider and a ball"
gravity = [0, 0, 0]
[run]
dt = 0.001
[[actor]]
name = "rod"
type = "box"
size = [1, 0.1, 0.1]
mass = 2
position = [0.5, 0, 1]
[[actor]]
name = "hand"
type = "box"
size = [0.4, 0.1, 0.1]
mass = 1
position = [1.2, 0, 1]
[[actor]]
name = "cart"
type = "box"
size = [0.2, 0.2, 0.2]
mass = 4
position = [9, 5, 1]
[[actor]]
name = "ball"
type = "sphere"
radius = 0.1
mass = 3
position = [0, -5, 1]
[[joint]]
name = "shoulder"
kind = "hinge"
bodies = ["rod", "world"]
anchor = [0, 0, 1]
axis = [0, 0, 1]
[[joint]]
name = "wrist"
kind = "universal"
bodies = ["hand", "rod"]
anchor = [1, 0, 1]
axis = [0, 0, 1]
axis2 = [0, 1, 0]
[[joint]]
name = "rail"
kind = "slider"
bodies = ["cart", "world"]
axis = [0, 1, 0]
)";

enum Body { rod, hand, cart, ball, num_bodies };
enum JointAxisOf { shoulder, wrist1, wrist2, rail, num_axes };

BatchOptions jointed(int num_worlds, const std::string& gravity = "[0, 0, 0]") {
  BatchOptions options;
  options.scene = "jointed";
  options.scene_text = jointed_scene;
  options.scene_text.replace(options.scene_text.find("[0, 0, 0]"), 9, gravity);
  options.num_worlds = num_worlds;
  return options;
}

std::vector<double> only(std::size_t count, std::size_t at, double value) {
  std::vector<double> values(count, 0);
  values[at] = value;
  return values;
}

std::vector<double> force_on(Body body, double x, double y, double z) {
  std::vector<double> forces(3 * num_bodies, 0);
  forces[3 * body] = x;
  forces[3 * body + 1] = y;
  forces[3 * body + 2] = z;
  return forces;
}

std::string refusal(const std::function<void()>& call) {
  try {
    call();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(Driving, names_the_axes_of_joints) {
  const Batch batch(jointed(1));
  ASSERT_EQ(batch.joint_axes().size(), std::size_t{num_axes});
  EXPECT_EQ(batch.joint_axes()[wrist2].name, "wrist/2");
  EXPECT_TRUE(batch.joint_axes()[rail].slides);
  EXPECT_FALSE(batch.joint_axes()[shoulder].slides);
}

TEST(Driving, a_force_moves_a_body_as_newton_says) {
  for (const char* gravity : {"[0, 0, 0]", "[0, 0, -9.81]"}) {
    Batch batch(jointed(1, gravity));
    const double g = std::string(gravity) == "[0, 0, 0]" ? 0 : 9.81;
    const double z = batch.state().position[3 * ball + 2];
    batch.set_forces(force_on(ball, 6, 0, 3 * g));
    batch.step(1000);
    EXPECT_NEAR(batch.state().position[3 * ball], 0.5 * 2 * 1 * 1, 1e-3) << "2 m/s^2 for 1 s";
    EXPECT_NEAR(batch.state().velocity[3 * ball], 2, 1e-9);
    EXPECT_NEAR(batch.state().position[3 * ball + 2], z, 1e-9) << "its weight is borne";
    batch.set_forces({});
    batch.step(10);
    EXPECT_NEAR(batch.state().velocity[3 * ball], 2, 1e-9) << "no force any more";
  }
}

TEST(Driving, a_torque_turns_a_body) {
  Batch batch(jointed(1));
  batch.set_forces({}, force_on(ball, 0, 0.6, 0));
  batch.step(1000);
  const double inertia = 0.4 * 3 * 0.01;
  EXPECT_NEAR(batch.state().angular_velocity[3 * ball + 1], 0.6 / inertia, 1e-6);
}

/// The cart has 4 kg and 1 s; the closed form is exact up to the first order of the step.
TEST(Driving, an_effort_on_a_slider_moves_its_cart) {
  Batch batch(jointed(1));
  batch.set_efforts(only(num_axes, rail, 8));
  batch.step(1000);
  EXPECT_NEAR(batch.joints().velocity[rail], 2, 1e-6);
  EXPECT_NEAR(batch.joints().position[rail], 1, 1e-3);
  EXPECT_NEAR(batch.state().position[3 * cart + 1], 6, 1e-3);
}

/// How rod and hand share it depends on the wrist; their sum about the shoulder does not.
TEST(Driving, an_effort_on_a_hinge_gives_its_angular_momentum) {
  Batch batch(jointed(1));
  constexpr double torque = 0.5, seconds = 0.5;
  batch.set_efforts(only(num_axes, shoulder, torque));
  batch.step(500);
  const BatchState& state = batch.state();
  double momentum = 0;
  for (const auto& [body, mass, inertia] :
       {std::tuple{rod, 2.0, 2.0 * (1 + 0.01) / 12}, std::tuple{hand, 1.0, 1.0 * (0.16 + 0.01) / 12}}) {
    const double* x = state.position.data() + 3 * body;
    const double* v = state.velocity.data() + 3 * body;
    momentum += mass * (x[0] * v[1] - x[1] * v[0]) + inertia * state.angular_velocity[3 * body + 2];
  }
  EXPECT_NEAR(momentum, torque * seconds, 1e-4);
}

TEST(Driving, an_effort_on_the_second_axis_of_a_joint_turns_its_first_body) {
  Batch batch(jointed(1));
  batch.set_efforts(only(num_axes, wrist2, 0.02));
  batch.step(200);
  const double inertia = (0.16 + 0.01) / 12 + 0.04;  // of the hand about the wrist
  EXPECT_NEAR(batch.joints().velocity[wrist2], 0.02 * 0.2 / inertia, 1e-4);
  EXPECT_NEAR(batch.joints().velocity[shoulder], 0, 1e-6) << "it turns out of the shoulder's plane";
}

TEST(Driving, positions_of_joints_are_the_integrals_of_their_velocities) {
  Batch batch(jointed(1));
  std::vector<double> efforts = {0.4, -0.02, 0.03, 2};
  batch.set_efforts(efforts);
  std::vector<double> sums(num_axes, 0);
  for (int step = 0; step < 800; ++step) {
    batch.step(1);
    for (std::size_t k = 0; k < num_axes; ++k) sums[k] += 1e-3 * batch.joints().velocity[k];
  }
  for (std::size_t k = 0; k < num_axes; ++k) {
    EXPECT_GT(std::abs(sums[k]), 0.05) << k;
    EXPECT_NEAR(batch.joints().position[k], sums[k], 5e-3 * std::abs(sums[k])) << k;
  }
}

/// A closed loop around the hinge: torque = k (target - angle) - d speed comes to rest where it bears the
/// weight.
TEST(Driving, a_loop_of_position_and_effort_comes_to_rest_at_its_steady_state) {
  BatchOptions options = jointed(1, "[0, -9.81, 0]");
  options.parameters.push_back(Parameters{{"hand.mass", "0.001"}});
  Batch batch(options);
  constexpr double stiffness = 60, damping = 12, target = 0.3;
  for (int step = 0; step < 5000; ++step) {
    const BatchJoints& joints = batch.joints();
    std::vector<double> efforts(num_axes, 0);
    efforts[shoulder] =
        stiffness * (target - joints.position[shoulder]) - damping * joints.velocity[shoulder];
    efforts[wrist1] = -0.01 * joints.position[wrist1] - 0.001 * joints.velocity[wrist1];
    batch.set_efforts(efforts);
    batch.step(1);
  }
  const double angle = batch.joints().position[shoulder];
  const double weight = 2 * 9.81 * 0.5 * std::cos(angle);
  EXPECT_NEAR(stiffness * (target - angle), weight, 0.03);
  EXPECT_NEAR(batch.joints().velocity[shoulder], 0, 1e-3);
}

/// An arm of MJCF with a position servo, which hangs across gravity, and a joint that only brakes.
BatchOptions servo(int num_worlds, const std::string& stepper) {
  BatchOptions options;
  options.scene = "servo";
  options.num_worlds = num_worlds;
  options.settings = {{"stepper", stepper}};
  options.scene_text =
      "<mujoco><worldbody><body name='arm' pos='0 0 1'><joint name='shoulder' axis='0 1 0'/>"
      "<geom type='capsule' fromto='0 0 0 .5 0 0' size='.05'/><body name='hand' pos='.5 0 0'>"
      "<joint name='wrist' axis='0 0 1' frictionloss='1'/><geom type='capsule' fromto='0 0 0 .2 0 0' "
      "size='.03'/>"
      "</body></body></worldbody><actuator><position joint='shoulder' kp='200' kv='20'/></actuator></mujoco>";
  return options;
}

TEST(Driving, targets_bring_the_axes_of_servos_where_they_are) {
  const double as_it_is = std::nan("");
  for (const char* stepper : {"sor", "quick"}) {
    Batch batch(servo(2, stepper));
    ASSERT_EQ(batch.motors().size(), 2u);
    EXPECT_EQ(batch.motors()[0].hold_rate, 10);
    EXPECT_EQ(batch.motors()[1].hold_rate, 0);
    batch.set_targets(std::vector<double>{-0.7, as_it_is, 0.4, as_it_is});
    const double seconds = 200 * batch.dt_s();
    batch.step(200);
    // exp(-rate t) of the way is left.
    EXPECT_NEAR(batch.joints().position[0], -0.7 * (1 - std::exp(-10 * seconds)), 0.01) << stepper;
    batch.step(600);
    EXPECT_NEAR(batch.joints().position[0], -0.7, 2e-3) << stepper;
    EXPECT_NEAR(batch.joints().position[2], 0.4, 2e-3) << stepper;
    const std::string refused = refusal([&] { batch.set_targets(std::vector<double>(4, 0)); });
    EXPECT_NE(refused.find("'servo.wrist' holds no pose"), std::string::npos) << refused;
    EXPECT_NE(refusal([&] { batch.set_targets(std::vector<double>(3, as_it_is)); }).find("3 targets"),
              std::string::npos);
  }
}

TEST(Driving, goes_on_after_a_load_and_ends_with_a_reset) {
  Batch batch(jointed(2)), other(jointed(2));
  std::vector<double> forces(2 * 3 * num_bodies, 0.1), efforts(2 * num_axes, 0.01);
  batch.set_forces(forces, forces);
  batch.set_efforts(efforts);
  batch.step(50);
  other.load(batch.save());
  for (Batch* each : {&batch, &other}) each->step(50);
  EXPECT_EQ(batch.hash(), other.hash());
  batch.reset(1);
  batch.step(20);
  Batch fresh(jointed(2));
  fresh.step(20);
  EXPECT_EQ(batch.hash(), fresh.hash());
}

TEST(Driving, one_call_of_many_steps_and_many_calls_have_the_same_bits) {
  Batch one(jointed(3)), many(jointed(3));
  const std::vector<double> efforts(3 * num_axes, 0.02), forces(3 * 3 * num_bodies, -0.3);
  for (Batch* each : {&one, &many}) {
    each->set_forces(forces);
    each->set_efforts(efforts);
  }
  one.step(40);
  for (int i = 0; i < 40; ++i) many.step(1);
  EXPECT_EQ(one.hash(), many.hash());
}

TEST(Driving, by_nothing_changes_no_bit) {
  Batch batch(jointed(1)), pushed(jointed(1));
  pushed.set_forces(std::vector<double>(3 * num_bodies, 0));
  pushed.set_efforts(std::vector<double>(num_axes, 0));
  for (Batch* each : {&batch, &pushed}) each->step(30);
  EXPECT_EQ(batch.hash(), pushed.hash());
}

TEST(Driving, refuses_wrong_arrays_and_steppers) {
  Batch batch(jointed(2));
  EXPECT_NE(
      refusal([&] { batch.set_forces(std::vector<double>(3)); }).find("3 numbers, and [2][4][3] are 24"),
      std::string::npos);
  EXPECT_NE(refusal([&] { batch.set_efforts(std::vector<double>(8, std::nan(""))); }).find("not finite"),
            std::string::npos);
  BatchOptions options = jointed(1);
  options.settings = {{"stepper", "quick"}};
  Batch quick(options);
  EXPECT_NE(refusal([&] { quick.set_efforts({}); }).find("only the stepper sor"), std::string::npos);
  EXPECT_EQ(quick.joints().position.size(), std::size_t{num_axes});
}

TEST(Driving, wakes_what_sleeps) {
  BatchOptions options = jointed(1);
  options.scene_text.replace(options.scene_text.find("[0, 0, 0]"), 9, "[0, 0, -9.81]");
  options.scene_text += "[[actor]]\nname = \"ground\"\ntype = \"ground\"\n";
  options.settings = {{"effects", "+sleeping"}};
  Batch batch(options);
  batch.step(4000);
  const double x = batch.state().position[3 * ball];
  ASSERT_EQ(batch.state().velocity[3 * ball], 0) << "it sleeps";
  batch.set_forces(force_on(ball, 30, 0, 0));
  batch.step(100);
  EXPECT_GT(batch.state().position[3 * ball], x + 0.01);
}

}  // namespace
}  // namespace pbmpi::test
