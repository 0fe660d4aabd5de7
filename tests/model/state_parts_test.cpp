#include "model/state_parts.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <vector>

#include "model/state.h"
#include "support/models.h"

namespace pbmpi::model {
namespace {

/// Two contacts of a pair, one with the ground, and the forces of two joints.
StepMemory sample() {
  StepMemory memory;
  memory.contacts = {{{0, 3}, 2, no_body, {0.1, -0.0, 1e-300}, 7, {0.5, 0.25, 1e300}},
                     {{2, 3}, 1, 2, {0.3, 0.2, 0.1}, 1.0 / 3, {1, 2, 3}},
                     {{2, 3}, 1, 2, {0.4, 0.2, 0.1}, 0, {0, 0, 0}}};
  memory.joints = {{{1, 2, 3}, {4, 5, 6}, {7, 8}, {9, 10}, {11, 12}},
                   {{0, -1, 0}, {0, 0, 1.0 / 7}, {0, 9}, {-0.0, 0}, {7.5, 0}}};
  return memory;
}

/// Every number differs from the others.
Rest resting() {
  Rest rest = {.position = {0.1, 0.2, 0.3},
               .orientation = {0.4, 0.5, 0.6, 0.7},
               .idle_steps = -8,
               .velocity = {9, 10, 11},
               .angular_velocity = {12, 13, -0.0}};
  for (const int i : {0, 1}) {
    const double first = 15.0 + 17 * i;
    rest.watches[i] = {.steps = 14 + 17 * i, .tremble = first + 14, .angular_tremble = first + 15};
    for (const int knot : {0, 1}) {
      const double at = first + 7 * knot;
      rest.watches[i].knots[knot] = {{at, at + 1, at + 2}, {at + 3, at + 4, at + 5, at + 6}};
    }
  }
  return rest;
}

template <class Row>
void expect_same_row(const Row& written) {
  constexpr std::size_t width = row_width<Row>;
  std::array<double, width> row, again;
  EXPECT_EQ(put_row(written, row.data()), row.data() + width);
  Row found;
  EXPECT_EQ(take_row(row.data(), found), row.data() + width);
  put_row(found, again.data());
  EXPECT_EQ(std::memcmp(row.data(), again.data(), sizeof row), 0);
}

TEST(StateRows, come_back_bit_for_bit) {
  for (const ContactForce& force : sample().contacts) expect_same_row(force);
  for (const JointForce& force : sample().joints) expect_same_row(force);
  expect_same_row(resting());
  expect_same_row(GuardMemory{1.0 / 3, 1e300, 17});
}

TEST(StateRows, have_their_parts_in_the_order_of_the_tables) {
  std::array<double, row_width<ContactForce>> contact;
  put_row(sample().contacts[1], contact.data());
  EXPECT_EQ(contact, (std::array<double, 11>{2, 3, 1, 2, 0.3, 0.2, 0.1, 1.0 / 3, 1, 2, 3}));
  std::array<double, row_width<JointForce>> joint;
  put_row(sample().joints[0], joint.data());
  EXPECT_EQ(joint, (std::array<double, 12>{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12}));
  std::array<double, row_width<Rest>> rest;
  put_row(resting(), rest.data());
  EXPECT_EQ(rest[7], -8);
  for (std::size_t i = 14; i < rest.size(); ++i) EXPECT_EQ(rest[i], static_cast<double>(i));
}

TEST(BodyRows, come_back_in_the_order_of_the_columns) {
  State state = initial_state(support::crash());
  for (int body = 0; body < state.num_bodies(); ++body) {
    state.position[body] = {1.0 * body, 2, 3};
    state.orientation[body] = {4, 5, 6, 7};
    state.velocity[body] = {8, 9, 10};
    state.angular_velocity[body] = {11, 12, -0.0};
  }
  const std::vector<int> bodies = {3, 1};
  EXPECT_EQ(body_rows(state, bodies), (std::vector<double>{3, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, -0.0,
                                                           1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, -0.0}));
  const std::vector<double> poses = body_rows(state, bodies, pose_columns);
  EXPECT_EQ(poses, (std::vector<double>{3, 2, 3, 4, 5, 6, 7, 1, 2, 3, 4, 5, 6, 7}));
  State other = initial_state(support::crash());
  put_body_rows(poses, bodies, other, pose_columns);
  EXPECT_EQ(other.position[3], state.position[3]);
  EXPECT_EQ(other.orientation[1], state.orientation[1]);
  EXPECT_NE(other.velocity[3], state.velocity[3]);
  EXPECT_NE(other.position[2], state.position[2]);
  put_body_rows(body_rows(state, bodies), bodies, other);
  EXPECT_EQ(other.velocity[3], state.velocity[3]);
  EXPECT_TRUE(std::signbit(other.angular_velocity[1].z()));
}

State remembering() {
  State state = initial_state(support::free_box());
  state.memory = sample();
  return state;
}

TEST(StateHash, is_that_of_poses_and_velocities_where_nothing_is_remembered) {
  const State without = initial_state(support::free_box());
  State zeros = without;
  zeros.memory.joints.resize(3);
  EXPECT_EQ(hash(zeros), hash(without)) << "joints without force are as good as none";
  EXPECT_NE(hash(remembering()), hash(without));
}

TEST(StateHash, changes_with_every_number_that_is_remembered) {
  std::vector<std::function<void(StepMemory&)>> changes = {
      [](StepMemory& m) { m.contacts[1].geoms.first = 1; },
      [](StepMemory& m) { m.contacts[1].geoms.second = 4; },
      [](StepMemory& m) { m.contacts[1].body_a = 0; },
      [](StepMemory& m) { m.contacts[1].body_b = no_body; },
      [](StepMemory& m) { m.contacts[1].normal = std::nextafter(m.contacts[1].normal, infinity); },
      [](StepMemory& m) { std::swap(m.contacts[1], m.contacts[2]); },
      [](StepMemory& m) { m.contacts.pop_back(); },
      [](StepMemory& m) { std::swap(m.joints[0], m.joints[1]); }};
  for (int k = 0; k < 3; ++k) {
    changes.emplace_back([k](StepMemory& m) { m.contacts[2].arm[k] += 1e-9; });
    changes.emplace_back([k](StepMemory& m) { m.contacts[2].friction[k] = -0.0; });
    changes.emplace_back([k](StepMemory& m) { m.joints[1].force[k] += 1e-9; });
    changes.emplace_back([k](StepMemory& m) { m.joints[1].torque[k] += 1e-9; });
  }
  for (const int axis : {0, 1})
    changes.emplace_back([axis](StepMemory& m) { m.joints[0].control[axis] += 1e-9; });
  const State state = remembering();
  for (std::size_t i = 0; i < changes.size(); ++i) {
    State other = state;
    EXPECT_EQ(hash(other), hash(state));
    changes[i](other.memory);
    EXPECT_NE(hash(other), hash(state)) << "change " << i;
  }
}

TEST(Forget, drops_the_contacts_of_a_body_and_the_forces_of_its_joints_only) {
  Model model;
  model.bodies.resize(4);
  model.joints.resize(2);
  model.joints[0].body_a = 3;
  model.joints[0].body_b = 1;
  model.joints[1].body_a = 2;  // to the world
  const auto left = [&](int body) {
    StepMemory memory = sample();
    forget(model, body, memory);
    EXPECT_EQ(memory.joints.size(), 2u);
    return memory;
  };
  const StepMemory without_1 = left(1);
  ASSERT_EQ(without_1.contacts.size(), 1u);
  EXPECT_EQ(without_1.contacts[0].geoms, (GeomPair{0, 3}));
  EXPECT_EQ(without_1.joints[0].force, Vec3::Zero());
  EXPECT_EQ(without_1.joints[0].torque, Vec3::Zero());
  EXPECT_EQ(without_1.joints[0].control[1], 0);
  EXPECT_EQ(without_1.joints[1].control[1], 9);
  EXPECT_TRUE(left(2).contacts.empty());
  EXPECT_EQ(left(2).joints[1].control[1], 0);
  EXPECT_EQ(left(0).contacts.size(), 3u);
  EXPECT_EQ(left(0).joints[0].control[1], 8);
}

}  // namespace
}  // namespace pbmpi::model
