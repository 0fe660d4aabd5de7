#include "effects/sleepers.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/models.h"

namespace pbmpi::effects {
namespace {

using Pairs = std::vector<BodyPair>;

constexpr double dt_s = 0.01;
constexpr int steps_of_rest = 50;  // the rule's half second

/// Balls in a row, none of which touches another. They hang in the air: what holds them is up to a test.
model::Model row_of_balls(int count) {
  model::Model model;
  const int actor = support::add_actor(model, "balls");
  for (int i = 0; i < count; ++i)
    support::add_solid(model, actor, "ball" + std::to_string(i), model::Shape::sphere, {0.1, 0, 0}, 1,
                       {1.0 * i, 0, 0});
  return model;
}

/// A world without a solver: bodies are where a test places them.
class World {
 public:
  explicit World(const model::Model& model)
      : model_(model), sleepers_(model_, dt_s), state_(model::initial_state(model)) {
    sleepers_.start(state_);
  }
  /// Ends `count` steps with these contacts, and one of each body with the ground.
  void steps(int count, Pairs touching = {}) {
    for (int body = 0; body < state_.num_bodies(); ++body) touching.emplace_back(body, model::no_body);
    steps_with(count, touching);
  }
  /// Ends `count` steps with no contacts but these.
  void steps_with(int count, const Pairs& touching) {
    for (int i = 0; i < count; ++i) {
      sleepers_.count(sleepers_.awake(), state_);
      const auto driven = [&](int joint) { return joint == driven_joint; };
      sleepers_.put_to_sleep(
          Sleepers::join(state_.num_bodies(),
                         sleepers_.find_resting(sleepers_.awake(), touching, driven, state_), {}),
          state_);
    }
  }
  /// Takes steps in which body `body` moves along x as `place` says [m], a function of time [s], until one
  /// ends in which it sleeps, or `seconds` have passed. Returns the time.
  template <class Place>
  double time_of_sleep(int body, double seconds, const Place& place) {
    const double start_m = state_.position[body].x();
    double before_m = place(0);
    for (int step = 1; step <= std::lround(seconds / dt_s); ++step) {
      const double now_m = place(step * dt_s);
      state_.position[body].x() = start_m + now_m;
      state_.velocity[body].x() = (now_m - before_m) / dt_s;
      before_m = now_m;
      steps(1);
      if (state_.rest[body].asleep()) return step * dt_s;
    }
    return model::infinity;
  }
  bool wake_touched(const Pairs& touching) {
    return sleepers_.wake(Sleepers::islands_touched(touching, state_), state_);
  }
  std::vector<int> asleep() const {
    std::vector<int> bodies;
    for (int body = 0; body < state_.num_bodies(); ++body) {
      if (state_.rest[body].asleep()) bodies.push_back(body);
    }
    return bodies;
  }
  Sleepers& sleepers() { return sleepers_; }
  model::State& state() { return state_; }

  int driven_joint = -1;

 private:
  model::Model model_;
  Sleepers sleepers_;
  model::State state_;
};

using Bodies = std::vector<int>;

TEST(Sleepers, let_a_body_sleep_once_it_has_rested_for_the_rules_time) {
  World world(row_of_balls(1));
  world.state().velocity[0] = {0.01, 0, 0};  // residual of a solver; the pose does not change
  world.steps(steps_of_rest - 1);
  EXPECT_EQ(world.asleep(), Bodies{});
  EXPECT_EQ(world.sleepers().awake().size(), 1u);
  world.steps(1);
  EXPECT_EQ(world.asleep(), Bodies{0});
  EXPECT_TRUE(world.sleepers().awake().empty());
  EXPECT_EQ(world.state().velocity[0], core::Vec3(0, 0, 0));
}

TEST(Sleepers, take_trembling_about_a_place_for_rest_and_a_slow_drift_for_motion) {
  World world(row_of_balls(3));
  for (int step = 0; step < 3 * steps_of_rest; ++step) {
    const double side = step % 2 == 0 ? 1 : -1;
    world.state().position[0].x() = 0.004 * side;
    world.state().velocity[0].x() = 0.8 * side;
    world.state().position[1].x() += 1.1 * 0.05 * dt_s;  // 10 % above the rule's speed
    world.state().orientation[2] = support::rotation(core::Vec3::UnitZ(), 1.1 * 0.1 * dt_s * step);
    world.steps(1);
  }
  EXPECT_EQ(world.asleep(), Bodies{0});
}

// A creep is a 500th of the rule's speeds.
TEST(Sleepers, let_a_creep_sleep_and_nothing_that_moves_faster) {
  World world(row_of_balls(4));
  for (int step = 0; step < 3 * steps_of_rest; ++step) {
    world.state().position[0].x() += 0.9 * 0.05 / 500 * dt_s;
    world.state().orientation[1] = support::rotation(core::Vec3::UnitZ(), 0.9 * 0.1 / 500 * dt_s * step);
    world.state().position[2].x() += 1.1 * 0.05 / 500 * dt_s;
    world.state().orientation[3] = support::rotation(core::Vec3::UnitZ(), 1.1 * 0.1 / 500 * dt_s * step);
    world.steps(1);
  }
  EXPECT_EQ(world.asleep(), (Bodies{0, 1}));
}

// Each is slower than the rule's 0.05 m/s for more than the rule's half second.
TEST(Sleepers, see_a_smooth_motion_however_slow_it_is) {
  const auto awake_for = [](double seconds, const auto& place) {
    return World(row_of_balls(1)).time_of_sleep(0, seconds, place) == model::infinity;
  };
  EXPECT_TRUE(awake_for(20, [](double t) { return 0.5e-4 * t * t; })) << "it begins to fall at 1e-4 m/s^2";
  EXPECT_TRUE(awake_for(8, [](double t) { return 0.04 * t - 0.005 * t * t; })) << "it turns back after 4 s";
  EXPECT_TRUE(awake_for(3, [](double t) { return 1e-5 * std::cosh(3.8 * t); })) << "it begins to tip";
  EXPECT_TRUE(awake_for(60, [](double t) { return 0.02 * std::sin(t); })) << "a soft spring";
  EXPECT_TRUE(awake_for(60, [](double t) { return 0.5 * std::cos(0.3 * t); })) << "a long pendulum";
}

TEST(Sleepers, let_sleep_what_has_come_to_rest_or_sways_a_little_about_its_place) {
  World settles(row_of_balls(1)), sways(row_of_balls(1));
  // 1e-4 m/s 0.23 s after the start; a window of a quarter second then ends within the next two intervals.
  EXPECT_LT(settles.time_of_sleep(0, 5, [](double t) { return 1e-3 * std::exp(-20 * t); }), 0.75);
  // A hand of a human that stands: 3 mm at 0.8 Hz.
  EXPECT_LT(sways.time_of_sleep(0, 5, [](double t) { return 0.003 * std::sin(5 * t); }), 4);
}

// Nothing that happens inside of what flies, such as two that tremble against each other, holds it up.
TEST(Sleepers, let_nothing_sleep_that_nothing_holds_unless_it_has_neither_weight_nor_velocity) {
  model::Model model = row_of_balls(4);
  support::add_joint(model, model::JointKind::ball, 3, model::no_body, {3, 0, 1});
  World weight(model);
  weight.steps_with(2 * steps_of_rest, {{0, 1}, {2, model::no_body}});
  EXPECT_EQ(weight.asleep(), (Bodies{2, 3})) << "one on the ground, one on a joint to the world";
  model.gravity.setZero();
  World weightless(model);
  weightless.state().velocity[0].x() = 1e-9;
  weightless.steps_with(2 * steps_of_rest, {{2, model::no_body}});
  EXPECT_EQ(weightless.asleep(), (Bodies{1, 2, 3}));
}

TEST(Sleepers, let_no_island_sleep_in_which_a_motor_turns) {
  model::Model model = row_of_balls(3);
  support::add_joint(model, model::JointKind::hinge, 1, 2, {1.5, 0, 0});
  model.joints[0].motors[0].max_force = 5;
  World world(model);
  world.driven_joint = 0;
  world.steps(2 * steps_of_rest);
  EXPECT_EQ(world.asleep(), Bodies{0});
  world.driven_joint = -1;
  world.steps(1);
  EXPECT_EQ(world.asleep(), (Bodies{0, 1, 2}));
}

TEST(Sleepers, let_an_island_sleep_as_a_whole_or_not_at_all) {
  model::Model model = row_of_balls(5);
  support::add_joint(model, model::JointKind::ball, 3, 4, {3.5, 0, 0});
  World world(model);
  const Pairs touching = {{0, 1}, {2, model::no_body}, {model::no_body, 3}};
  for (int step = 0; step < 2 * steps_of_rest; ++step) {
    world.state().position[1].x() += 0.01;  // 1 m/s, and 0 touches it
    world.state().position[4].x() += 0.01;  // and 3 is joined to it
    world.steps(1, touching);
  }
  EXPECT_EQ(world.asleep(), Bodies{2}) << "the environment joins nothing";
  world.steps(steps_of_rest + 1, touching);
  EXPECT_EQ(world.asleep(), (Bodies{0, 1, 2, 3, 4}));
  EXPECT_EQ(world.state().rest[1].island(), 0);
  EXPECT_EQ(world.state().rest[4].island(), 3);
}

TEST(Sleepers, wake_the_whole_island_that_an_awake_body_touches_and_no_other) {
  World world(row_of_balls(5));
  const Pairs touching = {{0, 1}, {1, 2}};
  for (int step = 0; step < steps_of_rest + 1; ++step) {
    world.state().position[4].x() += 0.01;
    world.steps(1, touching);
  }
  ASSERT_EQ(world.asleep(), (Bodies{0, 1, 2, 3}));
  EXPECT_FALSE(world.wake_touched({{0, 1}, {4, model::no_body}})) << "two that sleep, and one on the ground";
  EXPECT_TRUE(world.wake_touched({{2, 4}}));
  EXPECT_EQ(world.asleep(), Bodies{3});
  EXPECT_EQ(world.sleepers().awake().size(), 4u);
  EXPECT_EQ(world.state().rest[0].idle_steps, 0) << "it rests anew";
}

TEST(Sleepers, wake_what_an_event_concerns_in_its_step_only) {
  model::Model model = row_of_balls(4);
  support::add_joint(model, model::JointKind::hinge, 1, 2, {1.5, 0, 0});
  model::Event launch, motor;
  launch.step = 7;
  launch.body = 0;
  motor.step = 9;
  motor.kind = model::EventKind::motor;
  motor.joint = 0;
  model.events = {launch, motor};
  World world(model);
  world.steps(steps_of_rest);
  EXPECT_EQ(world.sleepers().islands_called(7, world.state()), std::vector<int>{0});
  EXPECT_EQ(world.sleepers().islands_called(8, world.state()), std::vector<int>{});
  EXPECT_EQ(world.sleepers().islands_called(9, world.state()), std::vector<int>{1});
  EXPECT_TRUE(world.sleepers().wake(std::vector<int>{1}, world.state()));
  EXPECT_EQ(world.asleep(), (Bodies{0, 3}));
  EXPECT_EQ(world.sleepers().islands_called(9, world.state()), std::vector<int>{}) << "it is awake";
}

TEST(Sleepers, go_on_from_a_state_that_others_have_left) {
  const model::Model model = row_of_balls(2);
  World first(model);
  first.steps(steps_of_rest - 1);
  model::State state = first.state();
  Sleepers next(model, dt_s);
  next.start(state);
  next.count(next.awake(), state);
  EXPECT_EQ(next.find_resting(
                    next.awake(), {}, [](int) { return false; }, state)
                .size(),
            2u);
}

// Parts of one island that two ranks own.
TEST(Sleepers, join_parts_of_islands_of_which_all_must_rest) {
  const std::vector<Resting> found = {{0, 0, true}, {1, 0, true}, {4, 4, true}, {6, 6, true}};
  const auto joined = [&](const Pairs& touching) {
    std::vector<std::pair<int, int>> bodies;
    for (const Resting& one : Sleepers::join(7, found, touching)) bodies.emplace_back(one.body, one.island);
    return bodies;
  };
  using Named = std::vector<std::pair<int, int>>;
  EXPECT_EQ(joined({}), (Named{{0, 0}, {1, 0}, {4, 4}, {6, 6}}));
  EXPECT_EQ(joined({{4, 1}}), (Named{{0, 0}, {1, 0}, {4, 0}, {6, 6}}));
  EXPECT_EQ(joined({{1, 5}}), (Named{{4, 4}, {6, 6}})) << "5 does not rest, nor what it touches";
  EXPECT_EQ(joined({{1, 4}, {4, 2}}), (Named{{6, 6}})) << "nor what touches that";
}

TEST(Sleepers, join_parts_of_islands_of_which_one_must_be_held) {
  const std::vector<Resting> found = {{0, 0, true}, {1, 1}, {2, 2, false, true}, {3, 3}};
  const auto bodies = [&](const Pairs& touching) {
    Bodies found_bodies;
    for (const Resting& one : Sleepers::join(4, found, touching)) found_bodies.push_back(one.body);
    return found_bodies;
  };
  EXPECT_EQ(bodies({}), (Bodies{0, 2})) << "nothing holds 1 and 3; nor 2, which is still";
  EXPECT_EQ(bodies({{1, 0}}), (Bodies{0, 1, 2}));
  EXPECT_EQ(bodies({{2, 3}}), Bodies{0}) << "3 moves";
  EXPECT_EQ(bodies({{3, model::no_body}}), (Bodies{0, 2, 3}));
}

}  // namespace
}  // namespace pbmpi::effects
