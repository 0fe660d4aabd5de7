#include "mpi/frame/whole_state.h"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>

#include "core/error.h"
#include "model/state_parts.h"

namespace pbmpi::mpi {
namespace {

std::vector<double> rest_rows(const model::State& state) {
  std::vector<double> rows;
  model::append_rows(state.rest, rows);
  return rows;
}

/// A NaN with a payload.
double odd_nan() {
  const std::uint64_t bits = 0x7ff8'0000'dead'beefULL;
  double number = 0;
  std::memcpy(&number, &bits, sizeof number);
  return number;
}

/// Has as many contact forces as joints.
model::State sample(bool rests, int num_joints) {
  model::State state;
  state.resize(3);
  for (int i = 0; i < 3; ++i) {
    state.position[i] = {0.1 * i, -0.0, std::numeric_limits<double>::denorm_min()};
    state.orientation[i] = {0.5, 0.1 * i, -0.3, odd_nan()};
    state.velocity[i] = {1.0 / 3, 1e300, -1e-300};
    state.angular_velocity[i] = {std::numeric_limits<double>::infinity(), 2.0 * i, 7};
  }
  if (rests) {
    state.rest.resize(3);
    state.rest[1] = {{0.7, 0.8, 0.9}, {0.1, 0.2, 0.3, 0.4}, -2};
    state.rest[1].velocity = {1, 2, 3};
    state.rest[1].watches[0] = {5, {{{{1, 2, 3}, {4, 5, 6, 7}}, {{8, 9, 10}, {11, 12, 13, 14}}}}, 0.1, 0.2};
    state.rest[2].watches[1] = {6, {}, 0.3, 0.4};
    state.rest[2].idle_steps = 29;
  }
  for (int joint = 0; joint < num_joints; ++joint) state.broken_in.push_back(joint == 1 ? 40000 : -1);
  for (int point = 0; point < num_joints; ++point)
    state.memory.contacts.push_back({{1, 2}, 1, point - 1, {0.1 * point, -0.0, 0.2}, odd_nan(), {1, 2, 3}});
  for (int joint = 0; joint < num_joints; ++joint)
    state.memory.joints.push_back({{0.1 * joint, 1, 2}, {-0.0, odd_nan(), 3}, {4, 1.0 / 3}});
  state.guard = {1.0 / 3, 1e300, rests ? 40001 : -1};
  return state;
}

template <class Row>
bool same_bytes(const std::vector<Row>& a, const std::vector<Row>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(Row)) == 0;
}

TEST(WholeState, comes_back_bit_for_bit_with_and_without_rest_joints_and_memory) {
  for (const bool rests : {false, true}) {
    for (const int num_joints : {0, 5}) {
      const model::State state = sample(rests, num_joints);
      const std::vector<double> packed = pack(state);
      const model::State found = unpack(packed);
      EXPECT_TRUE(same_bytes(found.position, state.position));
      EXPECT_TRUE(same_bytes(found.orientation, state.orientation));
      EXPECT_TRUE(same_bytes(found.velocity, state.velocity));
      EXPECT_TRUE(same_bytes(found.angular_velocity, state.angular_velocity));
      EXPECT_EQ(found.broken_in, state.broken_in);
      EXPECT_EQ(found.memory.contacts.size(), state.memory.contacts.size());
      EXPECT_EQ(found.memory.joints.size(), state.memory.joints.size());
      EXPECT_EQ(model::hash(found), model::hash(state)) << "all bits, of the memory too";
      EXPECT_EQ(found.guard.energy_gain_j, state.guard.energy_gain_j);
      EXPECT_EQ(found.guard.largest_kinetic_j, state.guard.largest_kinetic_j);
      EXPECT_EQ(found.guard.frozen_in, state.guard.frozen_in);
      EXPECT_EQ(rest_rows(found), rest_rows(state));
    }
  }
}

TEST(WholeState, lengths_that_do_not_fit_are_refused) {
  std::vector<double> packed = pack(sample(true, 5));
  packed.pop_back();
  EXPECT_THROW(unpack(packed), core::RunError);
  EXPECT_THROW(unpack(std::span(packed).first(2)), core::RunError);
  for (const double no_length : {-1.0, 1e300, std::numeric_limits<double>::quiet_NaN()}) {
    packed = pack(sample(true, 5));
    packed[1] = no_length;
    EXPECT_THROW(unpack(packed), core::RunError) << no_length;
  }
}

TEST(WholeState, a_state_of_another_model_is_refused) {
  model::Model model;
  model.bodies.resize(3);
  model.joints.resize(4);
  model.geoms.resize(3);
  EXPECT_NO_THROW(require_fit(0, sample(true, 4), model));
  EXPECT_NO_THROW(require_fit(0, sample(false, 0), model)) << "a state says of effects only what it has";
  EXPECT_THROW(require_fit(0, sample(false, 3), model), core::RunError);
  model.bodies.resize(2);
  EXPECT_THROW(require_fit(0, sample(false, 4), model), core::RunError);
}

TEST(WholeState, a_memory_of_another_model_is_refused) {
  model::Model model;
  model.bodies.resize(3);
  model.joints.resize(4);
  model.geoms.resize(3);
  const auto expect_refused = [&](const auto& change) {
    model::State state = sample(false, 4);
    change(state.memory);
    EXPECT_THROW(require_fit(0, state, model), core::RunError);
  };
  expect_refused([](model::StepMemory& memory) { memory.joints.pop_back(); });
  expect_refused([](model::StepMemory& memory) { memory.contacts[2].geoms.second = 3; });
  expect_refused([](model::StepMemory& memory) { memory.contacts[2].geoms.first = -1; });
  expect_refused([](model::StepMemory& memory) { memory.contacts[3].body_a = 3; });
  expect_refused([](model::StepMemory& memory) { memory.contacts[0].body_a = model::no_body; });
  expect_refused([](model::StepMemory& memory) { memory.contacts[0].body_b = -2; });
}

}  // namespace
}  // namespace pbmpi::mpi
