#include "mpi/spaces/space_driver.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "core/error.h"
#include "space_run.h"
#include "support/models.h"
#include "wrapped_space_stepper.h"

namespace pbmpi::mpi {
namespace {

using testing_support::neighbours;
using testing_support::ode_steps;
using testing_support::Oracle;
using testing_support::placements_of_four_spaces;
using testing_support::run_spaces;
using testing_support::share;
using testing_support::SharedModel;
using testing_support::space_settings;
using testing_support::SpaceRun;
using testing_support::whole_hash;
using testing_support::world;

/// Runs with the oracle and expects the bits of the undecomposed world.
SpaceRun expect_whole(const SharedModel& model, const WorldRunSettings& settings = space_settings(),
                      const stepping::StepperSettings& stepper = ode_steps) {
  SpaceRun run = run_spaces(world(), model, settings, stepper);
  EXPECT_EQ(run.result.state_hash, whole_hash(model, settings, stepper));
  EXPECT_EQ(run.result.failure, "");
  EXPECT_EQ(run.result.frames_done, settings.warmup + settings.frames);
  return run;
}

/// Expects of no space that it will be near others, so that root has to ask for those that are.
class Unexpecting final : public testing_support::WrappedSpaceStepper {
 public:
  using WrappedSpaceStepper::WrappedSpaceStepper;
  std::vector<int> near_spaces(std::span<const int> owner, std::span<const geometry::Box> boxes) override {
    // CrossingSearch asks twice a step: what is near now, and what will be.
    is_about_now_ = !is_about_now_;
    std::vector<int> near = WrappedSpaceStepper::near_spaces(owner, boxes);
    num_near_now_ += is_about_now_ ? std::ssize(near) : 0;
    return is_about_now_ ? near : std::vector<int>();
  }
  std::int64_t num_near_now() const { return num_near_now_; }

 private:
  bool is_about_now_ = false;
  std::int64_t num_near_now_ = 0;
};

TEST(SpaceDriver, asks_in_a_step_for_what_it_did_not_expect_to_be_near) {
  for (const SharedModel& model : {share(neighbours()), share(testing_support::shoot_out())}) {
    Unexpecting stepper(testing_support::make_space_stepper(model));
    SpaceDriver driver(world(), stepper, space_settings());
    EXPECT_EQ(driver.run().state_hash, whole_hash(model));
    EXPECT_TRUE(stepper.num_near_now() > 20 || !world().is_root() || world().size() == 1);
  }
}

TEST(SpaceDriver, has_the_bits_of_the_undecomposed_world_with_approaches) {
  const stepping::StepperSettings soft = default_settings(stepping::StepperKind::sor, stepping::Law::soft);
  for (const SharedModel& model : {share(neighbours()), share(testing_support::shoot_out())}) {
    const SpaceRun run = run_spaces(world(), model, space_settings(), soft, Oracle::none);
    EXPECT_EQ(run.result.state_hash, whole_hash(model, space_settings(), soft));
  }
}

TEST(SpaceDriver, has_the_bits_of_the_undecomposed_world) {
  const SpaceRun run = expect_whole(share(neighbours()), space_settings(40));
  EXPECT_TRUE(run.contacts_checked > 1000 || !world().is_root()) << "the scene must have contacts to find";
  EXPECT_EQ(run.messages > 0, world().size() > 1);
}

TEST(SpaceDriver, has_the_same_bits_for_every_ownership) {
  const SharedModel model = share(neighbours());
  const std::uint64_t expected = whole_hash(model);
  WorldRunSettings settings = space_settings();
  settings.rebalance_threshold = model::infinity;
  for (const Placement& placement : placements_of_four_spaces(world().size(), 5)) {
    settings.placement = placement;
    const SpaceRun run = run_spaces(world(), model, settings);
    ASSERT_EQ(run.result.state_hash, expected) << testing::PrintToString(placement);
    ASSERT_EQ(run.owners, settings.placement) << "with an infinite threshold nothing moves";
  }
}

// Speculative contacts: two balls that would pass through each other are in one space, others are shot at
// boxes of other spaces, so that with 4 owners both the ranks and root find speculative contacts.
TEST(SpaceDriver, sees_ahead_of_fast_bodies_across_spaces) {
  stepping::StepperSettings single = ode_steps;
  single.precision = stepping::Precision::single;
  for (const stepping::StepperSettings& stepper : {ode_steps, single}) {
    const SpaceRun run = expect_whole(share(testing_support::shoot_out()), space_settings(), stepper);
    EXPECT_TRUE(run.contacts_ahead_checked >= 4 || !world().is_root()) << run.contacts_ahead_checked;
  }
}

TEST(SpaceDriver, has_the_same_bits_with_one_lane_with_substeps_and_in_single_precision) {
  stepping::StepperSettings one_lane = ode_steps, substeps = ode_steps, single = ode_steps;
  one_lane.simd = stepping::Simd::off;
  substeps.substeps = 3;
  single.precision = stepping::Precision::single;
  for (const stepping::StepperSettings& stepper : {one_lane, substeps, single})
    expect_whole(share(neighbours()), space_settings(), stepper);
}

TEST(SpaceDriver, moves_spaces_when_the_work_is_uneven_and_keeps_the_bits) {
  WorldRunSettings settings = space_settings(30);
  settings.placement = {0, 0, 0, 0};
  settings.rebalance_threshold = 1.02;
  const SpaceRun run = expect_whole(share(neighbours()), settings);
  if (world().size() == 1) {
    EXPECT_TRUE(run.events.empty());
    return;
  }
  ASSERT_FALSE(run.events.empty()) << "all work on one rank must move";
  EXPECT_EQ(run.events.front().kind, "rebalance");
  EXPECT_NE(run.events.front().detail.find("moved: busiest rank"), std::string::npos);
  EXPECT_NE(run.owners, settings.placement);
  EXPECT_EQ(run.result.num_rebalances, std::ssize(run.events));
}

TEST(SpaceDriver, sends_no_message_inside_a_step_if_there_is_one_space) {
  const SpaceRun run = expect_whole(share(support::crash()));
  const std::int64_t frames = run.result.frames_done;
  // One message per frame: the account of each rank except root.
  EXPECT_EQ(run.messages, world().is_root() ? 0 : frames);
  std::vector<int> idle;
  for (int rank = 1; rank < world().size(); ++rank) idle.push_back(rank);
  EXPECT_EQ(run.idle_ranks, idle);
}

TEST(SpaceDriver, builds_no_machinery_for_spaces_that_never_meet) {
  model::Model model = neighbours();
  model.events.clear();
  model.spaces_meet = false;
  for (std::size_t i = 0; i < model.bodies.size(); ++i)
    model.bodies[i].pose.position.y() += 50.0 * model.geoms[i + 1].space;
  const SpaceRun run = expect_whole(share(model));
  EXPECT_EQ(run.messages, world().is_root() ? 0 : run.result.frames_done) << "one account a frame";
}

TEST(SpaceDriver, fails_if_spaces_touch_that_are_said_never_to_meet) {
  model::Model model = neighbours();
  model.spaces_meet = false;
  WorldRunSettings settings = space_settings();
  settings.placement = {0, 0, 0, world().size() - 1};
  std::string message;
  try {
    run_spaces(world(), share(model), settings, testing_support::ode_steps, Oracle::none);
  } catch (const core::RunError& error) {
    message = error.what();
  }
  EXPECT_EQ(message.find("inter_space = \"none\"") != std::string::npos, world().size() > 1) << message;
}

TEST(SpaceDriver, runs_with_an_empty_space_and_with_more_ranks_than_spaces) {
  model::Model model = neighbours();
  model.spaces = {"left", "middle", "right", "balls", "empty", "empty too"};
  WorldRunSettings settings = space_settings(10);
  settings.rebalance_threshold = model::infinity;
  const int last = world().size() - 1;
  settings.placement = {0, 0, 0, 0, last, last};  // the last rank owns nothing but empty spaces
  const SpaceRun run = expect_whole(share(model), settings);
  const auto idle = std::find(run.idle_ranks.begin(), run.idle_ranks.end(), last);
  EXPECT_EQ(idle != run.idle_ranks.end(), last > 0);

  model::Model two = neighbours();
  two.spaces = {"some", "others"};
  for (model::Geom& geom : two.geoms) geom.space /= 2;
  const SpaceRun few = expect_whole(share(two), space_settings(10));
  EXPECT_GE(std::ssize(few.idle_ranks), world().size() - 2);
}

TEST(SpaceDriver, merges_all_spaces_into_one_island_when_they_pile_up) {
  // The boxes of a pile, one per space: after the first contact all form one island, which one rank solves.
  model::Model model = support::pile(8);
  model.spaces.clear();
  for (model::Geom& geom : model.geoms) {
    if (geom.body == model::no_body) continue;
    geom.space = static_cast<int>(model.spaces.size());
    model.spaces.push_back("box" + std::to_string(geom.body));
  }
  WorldRunSettings settings = space_settings(40);
  settings.rebalance_threshold = model::infinity;
  expect_whole(share(model), settings);
  settings.rebalance_threshold = 1.1;
  expect_whole(share(model), settings);
}

TEST(SpaceDriver, follows_a_body_that_leaves_the_reach_of_all_spaces) {
  model::Model model = neighbours();
  model::Event event;
  event.step = 5;
  event.kind = model::EventKind::launch;
  event.body = 0;
  event.velocity = {4000, 0, 3000};
  event.pose = model::Pose{{1e5, -2e5, 50}, {}};
  model.events.insert(model.events.begin(), event);
  expect_whole(share(model));
}

TEST(SpaceDriver, follows_a_body_that_an_event_puts_among_another_spaces_bodies) {
  model::Model model = neighbours();
  model.events.clear();
  model::Event event;
  event.step = 7;
  event.kind = model::EventKind::launch;
  event.body = model.num_bodies() - 1;  // a ball
  event.velocity = {0, 0, -1};
  event.pose = model::Pose{{0.1, 0.3, 3.9}, {}};  // onto the left pile
  model.events = {event};
  for (int owner_of_balls = 0; owner_of_balls < world().size(); ++owner_of_balls) {
    WorldRunSettings settings = space_settings();
    settings.rebalance_threshold = model::infinity;
    settings.placement = {0, 0, 0, owner_of_balls};
    expect_whole(share(model), settings);
  }
}

TEST(SpaceDriver, solves_a_joint_between_bodies_of_two_spaces) {
  model::Model model = neighbours();
  const int first = 0, last = 11;  // a box of the left pile, and one of the right pile
  support::add_joint(model, model::JointKind::ball, first, last, {1, 0, 1});
  expect_whole(share(model));
}

TEST(SpaceDriver, ends_on_every_rank_when_a_body_becomes_non_finite) {
  model::Model model = neighbours();
  model.bodies[3].velocity.x() = std::numeric_limits<double>::quiet_NaN();
  const SpaceRun run =
      run_spaces(world(), share(model), space_settings(), testing_support::ode_steps, Oracle::none);
  EXPECT_NE(run.result.failure.find("world 0 has "), std::string::npos) << run.result.failure;
  EXPECT_NE(run.result.failure.find(" non-finite bod"), std::string::npos) << run.result.failure;
  EXPECT_EQ(run.result.frames_done, 1);
}

/// Throws in step 20 on one rank, while the others wait for its messages.
class FailingStepper final : public testing_support::WrappedSpaceStepper {
 public:
  FailingStepper(std::unique_ptr<stepping::SpaceStepper> inner, bool collide, bool here)
      : WrappedSpaceStepper(std::move(inner)), collide_(collide), here_(here) {}
  void fire_events(std::int64_t step) override {
    step_ = step;
    WrappedSpaceStepper::fire_events(step);
  }
  void collide(std::vector<model::Contact>& contacts) override {
    if (here_ && collide_ && step_ == 20) throw core::RunError("collider lost");
    WrappedSpaceStepper::collide(contacts);
  }
  void solve(std::span<const int> units, std::span<const model::Contact> contacts, std::int64_t step,
             core::PhaseTimes& times) override {
    if (here_ && !collide_ && step_ == 20) throw core::RunError("solver lost");
    WrappedSpaceStepper::solve(units, contacts, step, times);
  }

 private:
  bool collide_, here_;
  std::int64_t step_ = -1;
};

TEST(SpaceDriver, ends_all_ranks_with_the_error_of_one) {
  for (const bool collide : {true, false}) {
    for (int rank = 0; rank < world().size(); ++rank) {
      FailingStepper stepper(testing_support::make_space_stepper(share(neighbours())), collide,
                             rank == world().rank());
      SpaceDriver driver(world(), stepper, space_settings());
      std::string message;
      try {
        driver.run();
      } catch (const core::RunError& error) {
        message = error.what();
      }
      const std::string what = collide ? "collider lost" : "solver lost";
      EXPECT_EQ(message, world().size() == 1 ? what : "rank " + std::to_string(rank) + ": " + what);
    }
  }
}

TEST(SpaceDriver, refuses_a_placement_on_a_rank_that_does_not_exist) {
  WorldRunSettings settings = space_settings();
  settings.placement = {0, 0, 0, world().size()};
  EXPECT_THROW(run_spaces(world(), share(neighbours()), settings), core::InputError);
}

}  // namespace
}  // namespace pbmpi::mpi
