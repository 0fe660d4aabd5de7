// The effect "breakable_joints" in a world cut into spaces.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <utility>

#include "ode/collide/narrow_phase.h"
#include "solver/worlds/sor_stepper.h"
#include "space_run.h"
#include "stepping/stepper_traits.h"
#include "support/models.h"

namespace pbmpi::mpi {
namespace {

using testing_support::add_to_space;
using testing_support::expect_whole_in_placements;
using testing_support::Oracle;
using testing_support::run_spaces;
using testing_support::share;
using testing_support::SharedModel;
using testing_support::space_settings;
using testing_support::whole_hash;
using testing_support::world;

/// A row of four cubes, joined at their edges, that falls flat onto a cube of another space.
void add_row(model::Model& model, int row, double break_force, double break_torque) {
  const std::string name = "row" + std::to_string(row);
  const int actor = support::add_actor(model, name, model::ActorKind::prop, true);
  const double y = 2.0 * row;
  int before = model::no_body;
  for (int i = 0; i < 4; ++i) {
    const int cube =
        add_to_space(model,
                     support::add_solid(model, actor, name + "_" + std::to_string(i), model::Shape::box,
                                        {0.4, 0.4, 0.4}, 3, {0.41 * i, y, 1.2 + 0.1 * row}),
                     row);
    if (before != model::no_body) {
      const int joint =
          support::add_joint(model, row % 2 == 0 ? model::JointKind::hinge : model::JointKind::fixed, before,
                             cube, {0.41 * i - 0.205, y, 1.2 + 0.1 * row}, model::Vec3::UnitY());
      model.joints[joint].break_force = break_force;
      model.joints[joint].break_torque = break_torque;
    }
    before = cube;
  }
  const int block = support::add_actor(model, "block" + std::to_string(row));
  add_to_space(model,
               support::add_solid(model, block, "block" + std::to_string(row), model::Shape::box,
                                  {0.5, 0.5, 0.5}, 20, {0.2 + 0.41 * row, y, 0.25}),
               3);
}

/// Three rows in spaces of their own that fall onto cubes of a fourth space, so that the islands in which
/// they break lie on several ranks.
SharedModel falling_rows(bool sleeping) {
  model::Model model;
  model.spaces = {"first", "second", "third", "blocks"};
  support::add_ground(model);
  add_row(model, 0, 300, 0);
  add_row(model, 1, 400, 150);
  add_row(model, 2, 1200, 0);
  // In flight, and on the blocks, where with sleeping the row has fallen asleep.
  for (const auto& [step, joint] : {std::pair(30, 6), std::pair(190, 7)}) {
    model::Event event;
    event.kind = model::EventKind::release;
    event.step = step;
    event.joint = joint;
    model.events.push_back(event);
  }
  if (sleeping) model.effects["sleeping"] = true;
  return share(std::move(model));
}

constexpr int num_frames = 70;  // of 3 steps, of 0.01 s

class SpaceBreakage : public testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(AwakeAndWithSleep, SpaceBreakage, testing::Bool());

TEST_P(SpaceBreakage, has_the_bits_of_the_whole_world_for_every_ownership) {
  expect_whole_in_placements(falling_rows(GetParam()), num_frames, 37);
}

TEST_P(SpaceBreakage, has_the_bits_of_the_whole_world_while_spaces_change_their_owner) {
  const SharedModel model = falling_rows(GetParam());
  WorldRunSettings settings = space_settings(num_frames);
  settings.rebalance_threshold = 1;
  EXPECT_EQ(run_spaces(world(), model, settings, testing_support::ode_steps, Oracle::none).result.state_hash,
            whole_hash(model, settings));
}

TEST_P(SpaceBreakage, tells_of_each_joint_once_on_every_rank) {
  const SharedModel model = falling_rows(GetParam());
  WorldRunSettings settings = space_settings(num_frames);
  settings.rebalance_threshold = model::infinity;
  const auto whole = solver::make_sor_stepper(
      default_settings(stepping::StepperKind::sor, stepping::Law::ode), ode::make_narrow_phase);
  whole->add(0, model, model::initial_state(*model), 0);
  core::PhaseTimes times;
  whole->advance(3 * (num_frames + 2), times);
  std::multiset<std::string> expected, told;
  for (std::size_t joint = 0; joint < model->joints.size(); ++joint) {
    if (!whole->state(0).is_broken(joint)) continue;
    expected.insert("world 0: '" + model->joints[joint].name + "' broke in step " +
                    std::to_string(whole->state(0).broken_in[joint]));
  }
  for (const stepping::RunEvent& event :
       run_spaces(world(), model, settings, testing_support::ode_steps, Oracle::none).events) {
    EXPECT_EQ(event.kind, stepping::event_kind::joint_broken);
    told.insert(event.detail);
  }
  EXPECT_EQ(told, expected);
}

/// Makes sure that the scene tests what it should: joints break in several steps, and some hold.
TEST_P(SpaceBreakage, is_tried_where_joints_break_at_several_times) {
  const SharedModel model = falling_rows(GetParam());
  const auto worlds = solver::make_sor_stepper(
      default_settings(stepping::StepperKind::sor, stepping::Law::ode), ode::make_narrow_phase);
  worlds->add(0, model, model::initial_state(*model), 0);
  core::PhaseTimes times;
  worlds->advance(3 * (num_frames + 2), times);
  const auto& broken_in = worlds->state(0).broken_in;
  std::set<std::int32_t> steps(broken_in.begin(), broken_in.end());
  EXPECT_TRUE(steps.contains(model::unbroken));
  EXPECT_GE(steps.size(), 4u);
  if (!GetParam()) return;
  const auto& rest = worlds->state(0).rest;
  EXPECT_TRUE(std::any_of(rest.begin(), rest.end(), [](const model::Rest& one) { return one.asleep(); }));
}

}  // namespace
}  // namespace pbmpi::mpi
