#include "effects/step_rules.h"

#include <string>

#include <gtest/gtest.h>

#include "support/models.h"

namespace pbmpi::effects {
namespace {

using Calls = std::vector<std::string>;

constexpr double dt_s = 0.01;
constexpr int steps_of_rest = 50;  // the sleeping rule's half second

/// An engine that records the calls of the rules. Its bodies do not move.
class NotingWorld final : public RuledWorld {
 public:
  explicit NotingWorld(model::Model&&) = delete;  // the model must outlive its rules
  explicit NotingWorld(const model::Model& model)
      : state_(model::initial_state(model)), rules_(model, dt_s, 20, StepRules::World::whole, state_) {
    rules_.start();
  }

  void fire_events(std::int64_t step) override { calls.push_back("events of " + std::to_string(step)); }
  void store(std::span<const int> bodies, model::State& state) const override {
    calls.push_back("store " + std::to_string(bodies.size()));
    state.position = state_.position;
    state.orientation = state_.orientation;
    state.velocity = state_.velocity;
    state.angular_velocity = state_.angular_velocity;
  }
  void set_velocities(std::span<const int>, const model::State&) override {
    calls.emplace_back("set velocities");
  }
  bool may_be_fast() const override { return is_fast; }
  void add_speculative_contacts(FastBodies&, const model::State&) override { calls.emplace_back("ahead"); }
  std::span<const BodyPair> touching() override { return touches; }
  Reaction reaction(int joint) const override {
    calls.push_back("reaction of " + std::to_string(joint));
    return load;
  }
  bool is_driven(int) const override { return false; }
  void show_awake() override { calls.emplace_back("awake"); }
  void show_asleep(std::span<const int> bodies) override {
    calls.push_back("asleep " + std::to_string(bodies.size()));
  }
  void show_broken() override { calls.emplace_back("broken"); }

  /// Takes a step; returns how often it collided.
  int step(std::int64_t number) {
    calls.clear();
    rules_.begin_step(*this, number);
    int collisions = 1;
    while (rules_.after_collision(*this)) ++collisions;
    rules_.before_solve(*this);
    rules_.after_solve(*this, number);
    return collisions;
  }
  StepRules& rules() { return rules_; }
  model::State& state() { return state_; }

  mutable Calls calls;  ///< of the last step
  bool is_fast = false;
  std::vector<BodyPair> touches;
  Reaction load;

 private:
  model::State state_;
  StepRules rules_;
};

TEST(StepRules, ask_for_nothing_but_events_where_no_effect_acts_round_the_step) {
  const model::Model model = support::chain(3);
  NotingWorld world(model);
  world.step(4);
  EXPECT_EQ(world.calls, Calls{"events of 4"});
}

TEST(StepRules, look_ahead_then_sort_islands_by_the_state_at_the_start_of_the_step) {
  model::Model model = support::pile(2);
  model.bodies[1].velocity = {0, 0, -200};
  model.interest = model::Interest{{0, 0, 0}, model::no_body, 0.1, 4};
  NotingWorld world(model);
  world.is_fast = true;
  world.step(0);
  EXPECT_EQ(world.calls, (Calls{"events of 0", "store 2", "ahead"})) << "the state is read out once";
  EXPECT_EQ(world.rules().field()->inside().size() + world.rules().field()->outside().size(), 2u);
}

TEST(StepRules, read_no_state_out_for_what_may_be_ahead_where_nothing_may_be_fast) {
  model::Model model = support::pile(2);
  model.bodies[1].velocity = {0, 0, -200};
  NotingWorld world(model);
  world.step(0);
  EXPECT_EQ(world.calls, Calls{"events of 0"});
  world.is_fast = true;
  world.step(1);
  EXPECT_EQ(world.calls, (Calls{"events of 1", "store 2", "ahead"}));
}

TEST(StepRules, break_joints_before_islands_fall_asleep) {
  model::Model model = support::chain(3);
  model.joints[1].break_force = 100;
  model.effects["sleeping"] = true;
  model.gravity.setZero();  // what hangs still in the air may sleep
  NotingWorld world(model);
  for (int step = 0; step < steps_of_rest - 1; ++step) world.step(step);
  world.load.force_n = 101;
  world.step(steps_of_rest - 1);
  EXPECT_EQ(world.calls, (Calls{"events of 49", "reaction of 1", "broken", "store 3", "asleep 3"}));
  EXPECT_TRUE(world.state().is_broken(1));
  EXPECT_TRUE(world.rules().all_asleep());
}

TEST(StepRules, wake_islands_before_the_events_that_concern_them) {
  model::Model model = support::pile(2);
  model.effects["sleeping"] = true;
  model.gravity.setZero();  // what hangs still in the air may sleep
  model::Event& launch = model.events.emplace_back();
  launch.step = 60;
  launch.body = 1;
  NotingWorld world(model);
  for (int step = 0; step < 60; ++step) world.step(step);
  ASSERT_TRUE(world.rules().all_asleep());
  world.step(60);
  EXPECT_EQ(world.calls.at(0), "awake");
  EXPECT_EQ(world.calls.at(1), "events of 60");
}

TEST(StepRules, have_a_world_collide_again_until_nothing_more_wakes) {
  model::Model model = support::pile(3);
  model.effects["sleeping"] = true;
  model.gravity.setZero();  // what hangs still in the air may sleep
  NotingWorld world(model);
  for (int step = 0; step < steps_of_rest; ++step) world.step(step);
  ASSERT_TRUE(world.rules().all_asleep());
  world.rules().sleepers()->wake(std::vector<int>{0});
  EXPECT_EQ(world.step(50), 1) << "one body is awake, and touches nothing";
  world.touches = {{0, 1}, {1, 2}};
  EXPECT_EQ(world.step(51), 3) << "each collision finds one body more";
  EXPECT_EQ(world.rules().awake().size(), 3u);
}

TEST(StepRules, tell_whether_a_new_state_has_other_joints_broken) {
  const model::Model model = support::chain(3);
  NotingWorld world(model);
  EXPECT_FALSE(world.rules().start());
  world.state().broken_in = {model::unbroken, 7, model::unbroken};
  EXPECT_TRUE(world.rules().start());
  world.state().broken_in[1] = 8;
  EXPECT_FALSE(world.rules().start()) << "the same joints are broken";
}

TEST(StepRules, of_a_cut_world_leave_looking_ahead_to_its_ranks) {
  model::Model model = support::pile(2);
  model.bodies[1].velocity = {0, 0, -200};
  model::State state = model::initial_state(model);
  StepRules rules(model, dt_s, 20, StepRules::World::cut, state);
  NotingWorld engine(model);
  engine.is_fast = true;
  engine.calls.clear();
  EXPECT_FALSE(rules.after_collision(engine));
  EXPECT_EQ(engine.calls, Calls{});
}

}  // namespace
}  // namespace pbmpi::effects
