#include "effects/sleepers.h"

#include <gtest/gtest.h>

#include "support/models.h"

namespace pbmpi::effects {
namespace {

using Pairs = std::vector<BodyPair>;

constexpr double dt_s = 0.01;
constexpr int steps_of_rest = 50;  // the rule's half second

/// Balls in a row, none of which touches another.
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
  /// Ends `count` steps with these contacts.
  void steps(int count, const Pairs& touching = {}) {
    for (int i = 0; i < count; ++i) {
      sleepers_.count(sleepers_.awake(), state_);
      sleepers_.put_to_sleep(sleepers_.find_resting(sleepers_.awake(), touching, state_), state_);
    }
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
    world.state().position[0].x() = step % 2 == 0 ? 0.004 : -0.004;  // 0.8 m/s back and forth
    world.state().position[1].x() += 1.1 * 0.05 * dt_s;              // 10 % above the rule's speed
    world.state().orientation[2] = support::rotation(core::Vec3::UnitZ(), 1.1 * 0.1 * dt_s * step);
    world.steps(1);
  }
  EXPECT_EQ(world.asleep(), Bodies{0});
}

TEST(Sleepers, let_a_drift_below_the_rules_speeds_sleep) {
  World world(row_of_balls(2));
  for (int step = 0; step < steps_of_rest + 1; ++step) {
    world.state().position[0].x() += 0.9 * 0.05 * dt_s;
    world.state().orientation[1] = support::rotation(core::Vec3::UnitZ(), 0.9 * 0.1 * dt_s * step);
    world.steps(1);
  }
  EXPECT_EQ(world.asleep(), (Bodies{0, 1}));
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
  EXPECT_EQ(next.find_resting(next.awake(), {}, state).size(), 2u);
}

// Parts of one island that two ranks own.
TEST(Sleepers, join_parts_of_islands_of_which_all_must_rest) {
  const std::vector<Resting> found = {{0, 0}, {1, 0}, {4, 4}, {6, 6}};
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

}  // namespace
}  // namespace pbmpi::effects
