/// Motors whose targets a batch sets.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "pbmpi/batch.h"
#include "small_worlds.h"

namespace pbmpi::test {
namespace {

constexpr double as_it_is = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t door = 2, num_bodies = 4;

/// The door's angular velocity about z in a world [rad/s].
double turn(Batch& batch, std::size_t world) {
  return batch.state().angular_velocity[3 * (num_bodies * world + door) + 2];
}

TEST(Motors, turn_as_fast_as_they_are_told_until_they_are_told_otherwise) {
  for (const char* stepper : {"sor", "quick", "direct"}) {
    BatchOptions options = small_options(3);
    options.settings = {{"stepper", stepper}};
    Batch batch(options);
    batch.set_motor_velocities(std::array{1.5, as_it_is, -0.5});
    batch.step(50);
    // 1000 N m turn 30 kg within a step; the solver's remaining error is far below 1 %.
    EXPECT_NEAR(turn(batch, 0), 1.5, 0.015) << stepper;
    EXPECT_NEAR(turn(batch, 1), 0, 0.015) << stepper;
    EXPECT_NEAR(turn(batch, 2), -0.5, 0.015) << stepper;
    batch.set_motor_velocities(std::array{as_it_is, 1.0, as_it_is});
    batch.step(20);
    EXPECT_NEAR(turn(batch, 0), 1.5, 0.015) << stepper;
    EXPECT_NEAR(turn(batch, 1), 1, 0.015) << stepper;
  }
}

TEST(Motors, keep_their_aim_where_a_state_is_set_and_lose_it_in_a_reset) {
  Batch batch(small_options(2));
  batch.set_motor_velocities(std::array{1.0, 1.0});
  batch.step(30);
  batch.set_state(BatchState(batch.state()));
  batch.reset(std::array{false, true}, 1);
  batch.step(30);
  EXPECT_NEAR(turn(batch, 0), 1, 0.01);
  EXPECT_NEAR(turn(batch, 1), 0, 0.01);
  Batch fresh(small_options(2));
  fresh.step(30);
  EXPECT_EQ(batch.hash(1), fresh.hash(1));
}

TEST(Motors, go_on_after_a_load_as_if_nothing_had_been) {
  for (const char* stepper : {"sor", "quick"}) {
    BatchOptions options = small_options(2);
    options.settings = {{"stepper", stepper}};
    Batch batch(options), other(options);
    batch.set_motor_velocities(std::array{1.0, as_it_is});
    batch.step(10);
    const auto saved = batch.save();
    other.set_motor_velocities(std::array{as_it_is, 3.0});  // a load replaces this as well
    other.load(saved);
    for (Batch* each : {&batch, &other}) each->step(25);
    EXPECT_EQ(other.hash(), batch.hash()) << stepper;
    EXPECT_NEAR(turn(other, 0), 1, 0.01) << stepper;
  }
}

TEST(Motors, that_drive_what_sleeps_let_it_sleep_after_a_load) {
  for (const char* stepper : {"sor", "quick"}) {
    BatchOptions options = small_options(2);
    options.scene_text.replace(options.scene_text.find("velocity = 0"), 12, "velocity = 1");
    options.settings = {{"stepper", stepper}, {"effects", "+sleeping"}};
    Batch batch(options);
    batch.set_motor_velocities(std::array{0.0, as_it_is});
    batch.step(300);
    ASSERT_EQ(turn(batch, 0), 0) << stepper << ": it sleeps";
    ASSERT_NEAR(turn(batch, 1), 1, 0.01) << stepper;
    const auto saved = batch.save();
    Batch other(options);
    other.load(saved);
    EXPECT_EQ(other.hash(), batch.hash()) << stepper;
    for (Batch* each : {&batch, &other}) each->step(5);
    EXPECT_EQ(other.hash(), batch.hash()) << stepper;
  }
}

/// The gait of a centipede sets its motors by events.
TEST(Motors, whose_aim_an_event_has_ended_do_not_aim_again_after_a_load) {
  BatchOptions options;
  options.scene = "gait";
  options.scene_text = R"(
title = "one that walks"
[[actor]]
name = "ground"
type = "ground"
[[actor]]
name = "walker"
type = "centipede"
position = [0, 0, 0]
)";
  Batch batch(options), never_loaded(options);
  ASSERT_GT(batch.motors().size(), 0u);
  const std::vector<double> aims(batch.motors().size(), 0.3);
  batch.step(7);
  never_loaded.step(7);
  batch.set_motor_velocities(aims);
  never_loaded.set_motor_velocities(aims);
  for (int i = 0; i < 12; ++i) {
    batch.step(10);
    never_loaded.step(10);
    batch.load(batch.save());
    EXPECT_EQ(batch.hash(), never_loaded.hash()) << "after " << batch.steps()[0] << " steps";
  }
}

}  // namespace
}  // namespace pbmpi::test
