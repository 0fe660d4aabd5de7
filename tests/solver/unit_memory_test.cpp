#include "solver/spaces/unit_memory.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/error.h"
#include "model/state.h"
#include "model/state_parts.h"
#include "ode/collide/narrow_phase.h"
#include "solver/spaces/sor_space_stepper.h"
#include "stepping/stepper_traits.h"
#include "support/models.h"

namespace pbmpi::solver {
namespace {

using model::ContactForce;
using model::no_body;
using model::StepMemory;

/// A chain of three balls, a chain of two, and a single ball, which makes three units; the ground is geom 0.
model::Model three_units() {
  model::Model model;
  support::add_ground(model);
  const auto add = [&](int body, bool joined) {
    const std::string name = "ball" + std::to_string(body);
    const int actor = support::add_actor(model, name);
    support::add_solid(model, actor, name, model::Shape::sphere, {0.2, 0, 0}, 1, {1.0 * body, 0, 0.2});
    if (joined) support::add_joint(model, model::JointKind::ball, body - 1, body, {body - 0.5, 0, 0.2});
  };
  for (int body = 0; body < 6; ++body) add(body, body == 1 || body == 2 || body == 4);
  return model;
}

/// Contacts within a unit, between units, and with the ground; geom i + 1 is that of body i. All numbers
/// begin with `key`.
StepMemory memory_of(double key) {
  StepMemory memory;
  const auto add = [&](int first, int second, int a, int b) {
    const double number = key + static_cast<double>(memory.contacts.size());
    memory.contacts.push_back(
        {{first, second}, a, b, {number, -0.0, 1}, 2 * number, {0, 3 * number, number}});
  };
  add(0, 1, 0, no_body);
  add(0, 4, 3, no_body);
  add(0, 4, 3, no_body);
  add(1, 3, 0, 2);
  add(2, 5, 1, 4);
  add(4, 6, 3, 5);
  add(4, 6, 3, 5);
  for (int joint = 0; joint < 3; ++joint)
    memory.joints.push_back({{key, 1.0 * joint, 0}, {0, key, 1}, {key, 1.0 * joint}});
  return memory;
}

std::uint64_t hash_of(const StepMemory& memory) {
  model::State state;
  state.memory = memory;
  return model::hash(state);
}

class Units : public testing::Test {
 protected:
  std::vector<double> rows(std::vector<int> units, const StepMemory& memory) const {
    return memory_.rows(units, memory);
  }
  void put(std::vector<int> units, const std::vector<double>& rows, StepMemory& memory) const {
    memory_.put(units, rows, model_.joints.size(), memory);
  }

 private:
  model::Model model_ = three_units();
  model::SpaceMap map_ = model::make_space_map(model_);
  std::vector<Articulation> articulations_ = find_articulations(model_);
  UnitMemory memory_{map_, articulations_};
};

TEST_F(Units, give_the_contacts_of_their_first_bodies_and_their_joints) {
  const auto size = [](std::size_t contacts, std::size_t joints) {
    return 1 + model::row_width<model::ContactForce> * contacts +
           model::row_width<model::JointForce> * joints;
  };
  const StepMemory memory = memory_of(10);
  EXPECT_EQ(rows({0}, memory).size(), size(3, 2));
  EXPECT_EQ(rows({1}, memory).size(), size(4, 1));
  EXPECT_EQ(rows({2}, memory).size(), size(0, 0)) << "its contact belongs to the other body's unit";
  EXPECT_EQ(rows({0, 1, 2}, memory).size(), size(7, 3));
  EXPECT_EQ(rows({0, 1, 2}, {}), std::vector<double>{0});
}

TEST_F(Units, put_together_in_any_order_make_the_whole_memory) {
  const StepMemory whole = memory_of(10);
  std::vector<std::vector<int>> parts = {{0}, {1}, {2}};
  do {
    StepMemory found;
    for (const std::vector<int>& part : parts) put(part, rows(part, whole), found);
    EXPECT_EQ(hash_of(found), hash_of(whole));
  } while (std::next_permutation(parts.begin(), parts.end()));
}

TEST_F(Units, replace_what_was_known_of_them_alone) {
  const StepMemory old = memory_of(10), fresh = memory_of(20);
  StepMemory found = old;
  put({1}, rows({1}, fresh), found);
  ASSERT_EQ(found.contacts.size(), old.contacts.size());
  for (std::size_t i = 0; i < found.contacts.size(); ++i) {
    const ContactForce& expected = (found.contacts[i].body_a == 3 ? fresh : old).contacts[i];
    EXPECT_EQ(found.contacts[i].geoms, expected.geoms);
    EXPECT_EQ(found.contacts[i].normal, expected.normal);
    EXPECT_EQ(found.contacts[i].arm, expected.arm);
  }
  EXPECT_EQ(found.joints[1].control[0], 10);
  EXPECT_EQ(found.joints[2].control[0], 20);
}

TEST_F(Units, that_remember_nothing_any_more_leave_nothing_behind) {
  StepMemory found = memory_of(10);
  put({0, 1, 2}, {0}, found);
  EXPECT_EQ(hash_of(found), hash_of({}));
  put({0, 1, 2}, {0}, found = {});
  EXPECT_TRUE(found.empty());
}

TEST_F(Units, refuse_rows_of_another_length) {
  const StepMemory memory = memory_of(10);
  std::vector<double> of_two = rows({0, 1}, memory);
  StepMemory found;
  EXPECT_THROW(put({0}, of_two, found), std::logic_error);
  EXPECT_THROW(put({0, 1}, {}, found), std::logic_error);
  of_two.pop_back();
  EXPECT_THROW(put({0, 1}, of_two, found), std::logic_error);
}

TEST(SorSpaceStepper, takes_in_what_is_remembered_of_units_only_if_it_remembers) {
  const auto model = std::make_shared<const model::Model>(three_units());
  model::State state = model::initial_state(*model);
  state.memory = memory_of(10);
  for (const double warm_start : {0.0, 0.5}) {
    stepping::StepperSettings settings = default_settings(stepping::StepperKind::sor, stepping::Law::ode);
    settings.law.warm_start = warm_start;
    const auto here = make_sor_space_stepper(settings, ode::make_narrow_phase, model);
    const auto there = make_sor_space_stepper(settings, ode::make_narrow_phase, model);
    const std::vector<int> spaces = {0}, units = {0, 1, 2};
    here->own(spaces, state, 0);
    there->own(spaces, model::initial_state(*model), 0);
    EXPECT_EQ(here->remembers(), warm_start > 0);
    EXPECT_EQ(here->state().memory.empty(), warm_start == 0);
    there->put_memory(units, here->memory_rows(units));
    EXPECT_EQ(model::hash(there->state()), model::hash(here->state()));
  }
}

}  // namespace
}  // namespace pbmpi::solver
