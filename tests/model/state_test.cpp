#include "model/state.h"

#include <cmath>
#include <functional>
#include <limits>

#include <gtest/gtest.h>

#include "support/models.h"

namespace pbmpi::model {
namespace {

TEST(State, starts_as_the_model_says) {
  const Model model = support::free_box();
  const State state = initial_state(model);
  ASSERT_EQ(state.num_bodies(), 1);
  EXPECT_EQ(state.position[0], model.bodies[0].pose.position);
  EXPECT_EQ(state.orientation[0], model.bodies[0].pose.orientation);
  EXPECT_EQ(state.velocity[0], model.bodies[0].velocity);
  EXPECT_EQ(state.angular_velocity[0], model.bodies[0].angular_velocity);
}

/// One function for each of the 13 numbers of a body.
std::vector<std::function<double&(State&, int)>> all_fields() {
  std::vector<std::function<double&(State&, int)>> fields;
  for (int axis = 0; axis < 3; ++axis) {
    fields.emplace_back([axis](State& s, int body) -> double& { return s.position[body][axis]; });
    fields.emplace_back([axis](State& s, int body) -> double& { return s.velocity[body][axis]; });
    fields.emplace_back([axis](State& s, int body) -> double& { return s.angular_velocity[body][axis]; });
  }
  for (double Quat::*part : {&Quat::w, &Quat::x, &Quat::y, &Quat::z}) {
    fields.emplace_back([part](State& s, int body) -> double& { return s.orientation[body].*part; });
  }
  return fields;
}

TEST(StateHash, changes_with_the_last_bit_of_every_number) {
  const State state = initial_state(support::crash());
  const int last = state.num_bodies() - 1;
  for (const auto& field : all_fields()) {
    State other = state;
    EXPECT_EQ(hash(other), hash(state));
    field(other, last) = std::nextafter(field(other, last), infinity);
    EXPECT_NE(hash(other), hash(state));
  }
}

TEST(StateHash, tells_two_bodies_apart) {
  Model model = support::crash();
  const State state = initial_state(model);
  std::swap(model.bodies[0], model.bodies[1]);
  EXPECT_NE(hash(initial_state(model)), hash(state));
}

TEST(StateHash, tells_since_when_a_world_stands_and_nothing_else_that_guards_remember) {
  const State state = initial_state(support::free_box());
  State other = state;
  other.guard.energy_gain_j = other.guard.largest_kinetic_j = 7;
  EXPECT_EQ(hash(other), hash(state));
  other.guard.frozen_in = 0;
  State later = other;
  later.guard.frozen_in = 1;
  EXPECT_NE(hash(other), hash(state));
  EXPECT_NE(hash(other), hash(later));
}

TEST(CountNonfinite, finds_every_bad_number_and_counts_bodies) {
  const State state = initial_state(support::crash());
  EXPECT_EQ(count_nonfinite(state), 0);
  for (const auto& field : all_fields()) {
    for (const double bad : {std::numeric_limits<double>::quiet_NaN(), infinity, -infinity}) {
      State other = state;
      field(other, 3) = bad;
      EXPECT_EQ(count_nonfinite(other), 1);
    }
  }
  State other = state;
  other.position[0].setConstant(infinity);
  other.velocity[2].setConstant(infinity);
  EXPECT_EQ(count_nonfinite(other), 2);
}

}  // namespace
}  // namespace pbmpi::model
