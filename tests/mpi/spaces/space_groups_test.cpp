// Many worlds, each cut into spaces over a group of ranks, compared with the same worlds in one piece.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <map>

#include "../world_driver_support.h"
#include "core/error.h"
#include "ode/collide/narrow_phase.h"
#include "solver/worlds/sor_stepper.h"
#include "space_run.h"
#include "stability/guarded_stepper.h"
#include "wrapped_space_stepper.h"

namespace pbmpi::mpi {
namespace {

namespace event_kind = stepping::event_kind;
using stability::OnBlowup;
using testing_support::share;
using testing_support::SharedModel;
using testing_support::world;

constexpr int num_worlds = 3;

/// Worlds that all differ.
std::vector<SharedModel> three_worlds() {
  std::vector<SharedModel> worlds;
  for (int number = 0; number < num_worlds; ++number) {
    model::Model model = testing_support::neighbours();
    for (model::Body& body : model.bodies) body.velocity.y() += 0.1 * number;
    worlds.push_back(share(std::move(model)));
  }
  return worlds;
}

WorldRunSettings group_settings(int frames = 12, double rebalance_threshold = model::infinity) {
  WorldRunSettings settings = testing_support::space_settings(frames);
  settings.num_worlds = num_worlds;
  settings.first_world = 5;
  settings.rebalance_threshold = rebalance_threshold;
  return settings;
}

/// Groups of the test's ranks; all spaces cost the same.
RankGroups groups_of(int ranks_per_world) {
  return group_ranks(std::vector<double>{1, 1, 1, 1}, num_worlds, world().size(), ranks_per_world);
}

class Shelf : public SnapshotKeeper {
 public:
  std::string keep(Snapshot snapshot) override {
    snapshots.push_back(std::move(snapshot));
    return "kept";
  }
  std::vector<Snapshot> snapshots;
};

/// Records all poses that root gets.
class Poses final : public stepping::PoseConsumer {
 public:
  void poses(std::int64_t, stepping::PoseKind kind, std::span<const model::Vec3> position,
             std::span<const model::Quat> orientation) override {
    auto& kept = kind == stepping::PoseKind::estimate ? estimates : precise;
    for (const model::Vec3& one : position) kept.insert(kept.end(), one.begin(), one.end());
    for (const model::Quat& one : orientation) kept.insert(kept.end(), {one.w, one.x, one.y, one.z});
  }
  std::vector<double> precise, estimates;
};

struct GroupRun {
  WorldRunResult result;
  testing_support::Recorder seen;
  Poses poses;
  std::vector<int> idle_ranks;
  std::vector<model::State> saved;  ///< on root, after the last frame
};

/// Optional parts of a run.
struct With {
  std::span<const model::State> states{};
  const stability::GuardSettings* guards = nullptr;
  bool estimates = false;
};

GroupRun run_cut(const Communicator& comm, const std::vector<SharedModel>& worlds, const RankGroups& groups,
                 const WorldRunSettings& settings, const With& with = {}) {
  std::vector<std::unique_ptr<stepping::SpaceStepper>> owned;
  const auto make_steppers = [&] {
    std::vector<stepping::SpaceStepper*> steppers;
    for (const int number : groups.worlds_of(groups.group_of_rank(comm.rank())))
      steppers.push_back(owned.emplace_back(testing_support::make_space_stepper(worlds[number])).get());
    return steppers;
  };
  SpaceDriver driver(comm, make_steppers(), groups, settings, with.states);
  if (with.guards != nullptr) driver.watch(*with.guards);
  if (with.estimates) driver.estimate_with(make_steppers());
  GroupRun run;
  Shelf shelf;
  CheckpointPlan plan;
  plan.at_end = true;
  driver.save_to(shelf, plan);
  driver.add_observer(run.seen);
  driver.add_consumer(run.poses);
  run.result = driver.run();
  run.idle_ranks = driver.idle_ranks();
  if (!shelf.snapshots.empty()) run.saved = shelf.snapshots.back().worlds;
  return run;
}

GroupRun run_whole(const std::vector<SharedModel>& worlds, WorldRunSettings settings,
                   const stability::GuardSettings* guards = nullptr) {
  settings.placement.clear();
  stability::GuardSettings none;
  none.stepper = testing_support::ode_steps;
  none.make_stepper = [](const stepping::StepperSettings& one) {
    return solver::make_sor_stepper(one, ode::make_narrow_phase);
  };
  const stability::GuardSettings& used = guards == nullptr ? none : *guards;
  stability::GuardedStepper stepper(used.make_stepper(used.stepper), used);
  WorldDriver driver(
      Communicator(), stepper, [&](int number) { return worlds[number]; }, settings);
  if (guards != nullptr) driver.set_event_source(stepper);
  GroupRun run;
  driver.add_observer(run.seen);
  driver.add_consumer(run.poses);
  run.result = driver.run();
  return run;
}

/// Each way to group the ranks of the test.
std::vector<RankGroups> all_groups() {
  std::vector<RankGroups> all;
  for (int ranks_per_world = 1; ranks_per_world <= world().size(); ++ranks_per_world)
    all.push_back(groups_of(ranks_per_world));
  return all;
}

std::string text_of(const RankGroups& groups) { return testing::PrintToString(groups.ranks); }

TEST(SpaceGroups, have_the_bits_and_the_poses_of_the_whole_worlds) {
  const std::vector<SharedModel> worlds = three_worlds();
  const WorldRunSettings settings = group_settings();
  const GroupRun whole = run_whole(worlds, settings);
  for (const RankGroups& groups : all_groups()) {
    const GroupRun cut = run_cut(world(), worlds, groups, settings);
    EXPECT_EQ(cut.result.state_hash, whole.result.state_hash) << text_of(groups);
    if (world().is_root()) {
      EXPECT_EQ(cut.poses.precise, whole.poses.precise) << text_of(groups);
    }
    const int group = groups.group_of_rank(world().rank());
    const bool reports = group < groups.num_groups() && groups.first_rank(group) == world().rank();
    for (const testing_support::Recorder::Frame& frame : cut.seen.frames)
      EXPECT_EQ(frame.worlds, reports ? groups.worlds_of(group) : std::vector<int>());
  }
}

TEST(SpaceGroups, name_the_ranks_that_no_group_has_use_for) {
  const RankGroups groups = group_ranks(std::vector<double>{1, 1, 1, 1}, num_worlds, world().size(), 1);
  std::vector<int> idle;
  for (int rank = num_worlds; rank < world().size(); ++rank) idle.push_back(rank);
  EXPECT_EQ(run_cut(world(), three_worlds(), groups, group_settings(2)).idle_ranks, idle);
}

TEST(SpaceGroups, keep_the_bits_while_spaces_move_within_each_group) {
  const std::vector<SharedModel> worlds = three_worlds();
  WorldRunSettings settings = group_settings(24, 1.02);
  const std::uint64_t expected = run_whole(worlds, settings).result.state_hash;
  settings.placement = {0, 0, 0, 0};
  for (const RankGroups& groups : all_groups()) {
    const GroupRun cut = run_cut(world(), worlds, groups, settings);
    EXPECT_EQ(cut.result.state_hash, expected) << text_of(groups);
    EXPECT_EQ(std::ssize(cut.seen.events) - 1, cut.result.num_rebalances) << "and the checkpoint at the end";
    if (std::ranges::max(groups.ranks) == 1) {
      EXPECT_EQ(cut.result.num_rebalances, 0);
      continue;
    }
    ASSERT_GT(cut.result.num_rebalances, 0) << "all work on one rank of a group must move";
    EXPECT_EQ(cut.seen.events.front().kind, event_kind::rebalance);
    EXPECT_NE(cut.seen.events.front().detail.find(" moved, of "), std::string::npos);
  }
}

TEST(SpaceGroups, estimate_the_same_poses_whatever_the_groups) {
  const std::vector<SharedModel> worlds = three_worlds();
  const WorldRunSettings settings = group_settings(5);
  const GroupRun alone =
      run_cut(Communicator(), worlds, RankGroups::of_all(1, num_worlds), settings, {.estimates = true});
  EXPECT_EQ(alone.poses.estimates.size(), alone.poses.precise.size());
  for (const RankGroups& groups : all_groups()) {
    const GroupRun cut = run_cut(world(), worlds, groups, settings, {.estimates = true});
    EXPECT_EQ(cut.result.state_hash, alone.result.state_hash) << text_of(groups);
    if (!world().is_root()) continue;
    EXPECT_EQ(cut.poses.estimates, alone.poses.estimates) << text_of(groups);
    EXPECT_EQ(cut.poses.precise, alone.poses.precise) << text_of(groups);
  }
}

TEST(SpaceGroups, go_on_from_saved_states_in_other_groups) {
  const std::vector<SharedModel> worlds = three_worlds();
  const WorldRunSettings whole = group_settings(12);
  const std::uint64_t expected = run_whole(worlds, whole).result.state_hash;
  WorldRunSettings first = whole, rest = whole;
  first.frames = 5;
  rest.first_frame = first.warmup + first.frames;
  const std::vector<RankGroups> forms = all_groups();
  for (std::size_t form = 0; form < forms.size(); ++form) {
    const GroupRun before = run_cut(world(), worlds, forms[form], first);
    EXPECT_EQ(before.saved.size(), world().is_root() ? worlds.size() : 0U);
    const RankGroups& other = forms[(form + 1) % forms.size()];
    EXPECT_EQ(run_cut(world(), worlds, other, rest, {.states = before.saved}).result.state_hash, expected);
    if (world().is_root()) {
      const GroupRun alone =
          run_cut(Communicator(), worlds, RankGroups::of_all(1, num_worlds), rest, {.states = before.saved});
      EXPECT_EQ(alone.result.state_hash, expected);
    }
  }
}

TEST(SpaceGroups, refuse_to_go_on_from_fewer_states_than_worlds) {
  const std::vector<SharedModel> worlds = three_worlds();
  WorldRunSettings rest = group_settings();
  rest.first_frame = 4;
  const std::vector<model::State> two = {model::initial_state(*worlds[0]), model::initial_state(*worlds[1])};
  for (const RankGroups& groups : all_groups())
    EXPECT_THROW(run_cut(world(), worlds, groups, rest, {.states = two}), core::RunError);
}

/// Three worlds; in the second a launch puts a ball into a box of another space in step 22.
std::vector<SharedModel> one_on_collision_course() {
  std::vector<SharedModel> worlds = three_worlds();
  worlds[1] = share(testing_support::on_collision_course(*worlds[1]));
  return worlds;
}

/// Events of guards; groups also report checkpoints and rebalances.
std::vector<std::string> told(const GroupRun& run) {
  std::vector<std::string> found;
  for (const stepping::RunEvent& event : run.seen.events) {
    if (event.kind != event_kind::rebalance && event.kind != event_kind::checkpoint)
      found.push_back(event.kind + " " + std::to_string(event.world) + " " + event.detail);
  }
  return found;
}

class EveryAction : public testing::TestWithParam<OnBlowup> {};
INSTANTIATE_TEST_SUITE_P(Actions, EveryAction,
                         testing::Values(OnBlowup::report, OnBlowup::stop, OnBlowup::freeze,
                                         OnBlowup::refine));

TEST_P(EveryAction, does_to_one_world_of_a_group_what_it_does_to_the_whole_one) {
  const std::vector<SharedModel> worlds = one_on_collision_course();
  WorldRunSettings settings = group_settings(20, 1);
  settings.stop_at_blowup = GetParam() == OnBlowup::stop;
  const stability::GuardSettings guards{GetParam(),
                                        testing_support::ode_steps,
                                        [](const stepping::StepperSettings& one) {
                                          return solver::make_sor_stepper(one, ode::make_narrow_phase);
                                        },
                                        {.energy_share = 1e-3, .energy_lift_m = 1e-3}};
  const GroupRun whole = run_whole(worlds, settings, &guards);
  const std::vector<std::string> expected = told(whole);
  ASSERT_FALSE(expected.empty());
  for (const RankGroups& groups : all_groups()) {
    const GroupRun cut = run_cut(world(), worlds, groups, settings, {.guards = &guards});
    EXPECT_EQ(cut.result.state_hash, whole.result.state_hash) << text_of(groups);
    EXPECT_EQ(told(cut), expected) << text_of(groups);
    EXPECT_EQ(cut.result.failure, whole.result.failure) << text_of(groups);
  }
}

TEST(SpaceGroups, end_on_every_rank_when_a_body_of_one_world_becomes_non_finite) {
  std::vector<SharedModel> worlds = three_worlds();
  model::Model lost = *worlds[2];
  lost.bodies[3].velocity.x() = std::numeric_limits<double>::quiet_NaN();
  worlds[2] = share(std::move(lost));
  const std::string expected = run_whole(worlds, group_settings()).result.failure;
  EXPECT_NE(expected.find("world 7 has "), std::string::npos) << "its number in the ensemble: " << expected;
  for (const RankGroups& groups : all_groups()) {
    const GroupRun cut = run_cut(world(), worlds, groups, group_settings());
    EXPECT_EQ(cut.result.failure, expected) << text_of(groups);
    EXPECT_EQ(cut.result.frames_done, 1);
  }
}

/// Throws in step 10, in the collider or in the solver.
class FailingStepper final : public testing_support::WrappedSpaceStepper {
 public:
  FailingStepper(const SharedModel& model, bool collides)
      : WrappedSpaceStepper(testing_support::make_space_stepper(model)), collides_(collides) {}
  void fire_events(std::int64_t step) override {
    step_ = step;
    WrappedSpaceStepper::fire_events(step);
  }
  void collide(std::vector<model::Contact>& contacts) override {
    if (collides_ && step_ == 10) throw core::RunError("step lost");
    WrappedSpaceStepper::collide(contacts);
  }
  void solve(std::span<const int> units, std::span<const model::Contact> contacts, std::int64_t step,
             core::PhaseTimes& times) override {
    if (!collides_ && step_ == 10) throw core::RunError("step lost");
    WrappedSpaceStepper::solve(units, contacts, step, times);
  }

 private:
  bool collides_;
  std::int64_t step_ = -1;
};

/// The error that ends a run in which rank `rank` fails in the last world of its group.
std::string error_of_run(const RankGroups& groups, int rank, bool collides) {
  const std::vector<SharedModel> worlds = three_worlds();
  const std::vector<int> own = groups.worlds_of(groups.group_of_rank(world().rank()));
  std::vector<std::unique_ptr<stepping::SpaceStepper>> owned;
  std::vector<stepping::SpaceStepper*> steppers;
  for (const int number : own) {
    if (rank == world().rank() && number == own.back()) {
      owned.push_back(std::make_unique<FailingStepper>(worlds[number], collides));
    } else {
      owned.push_back(testing_support::make_space_stepper(worlds[number]));
    }
    steppers.push_back(owned.back().get());
  }
  SpaceDriver driver(world(), steppers, groups, group_settings());
  try {
    driver.run();
  } catch (const core::RunError& error) {
    return error.what();
  }
  return "";
}

TEST(SpaceGroups, end_all_ranks_with_the_error_of_one) {
  for (const RankGroups& groups : all_groups()) {
    for (int rank = 0; rank < world().size(); ++rank) {
      if (groups.group_of_rank(rank) == groups.num_groups()) continue;
      for (const bool collides : {true, false}) {
        EXPECT_EQ(error_of_run(groups, rank, collides),
                  world().size() == 1 ? "step lost" : "rank " + std::to_string(rank) + ": step lost")
            << text_of(groups);
      }
    }
  }
}

TEST(SpaceGroups, refuse_a_placement_on_a_rank_that_a_group_has_not) {
  WorldRunSettings settings = group_settings();
  settings.placement = {0, 0, 0, 1};
  if (world().size() == 1) return;
  EXPECT_THROW(run_cut(world(), three_worlds(), groups_of(1), settings), core::InputError);
}

}  // namespace
}  // namespace pbmpi::mpi
