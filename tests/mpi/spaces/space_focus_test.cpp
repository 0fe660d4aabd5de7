// The effect "field_of_interest" in a world cut into spaces.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "ode/collide/narrow_phase.h"
#include "solver/worlds/sor_stepper.h"
#include "space_run.h"
#include "stepping/stepper_traits.h"
#include "support/models.h"

namespace pbmpi::mpi {
namespace {

using testing_support::expect_whole_in_placements;
using testing_support::make_space_stepper;
using testing_support::neighbours;
using testing_support::Oracle;
using testing_support::run_spaces;
using testing_support::share;
using testing_support::SharedModel;
using testing_support::space_settings;
using testing_support::SpaceRun;
using testing_support::whole_hash;
using testing_support::world;

/// A field of interest around the last ball, which rolls, is launched into the middle, and falls on a pile.
model::Model followed_ball() {
  model::Model model = neighbours();
  model.interest = model::Interest{{0, 0, 0}, model.num_bodies() - 1, 1.2, 3};
  return model;
}

/// A field of interest around a fixed point in the middle.
model::Model watched_place() {
  model::Model model = neighbours();
  model.interest = model::Interest{{1, 0, 3}, model::no_body, 1, 3};
  return model;
}

/// Records how many bodies were inside, on the ranks that report worlds.
class InsideRecorder : public stepping::FrameObserver {
 public:
  void frame_done(const stepping::FrameRecord& frame) override {
    if (!frame.worlds.empty()) inside.push_back(frame.worlds.front().observables->bodies_inside);
  }
  std::vector<int> inside;
};

std::vector<int> inside_of(FrameDriver& driver) {
  InsideRecorder recorder;
  driver.add_observer(recorder);
  driver.run();
  return recorder.inside;
}

TEST(SpaceFocus, has_the_bits_of_the_whole_world_for_every_ownership) {
  for (const SharedModel& model : {share(followed_ball()), share(watched_place())})
    expect_whole_in_placements(model, 20, 23);
}

TEST(SpaceFocus, has_the_bits_of_the_whole_world_while_spaces_change_their_owner) {
  WorldRunSettings settings = space_settings(30);
  settings.placement = {0, 0, 0, 0};
  settings.rebalance_threshold = 1;
  const SharedModel model = share(followed_ball());
  const SpaceRun run = run_spaces(world(), model, settings);
  EXPECT_EQ(run.result.state_hash, whole_hash(model, settings));
  EXPECT_EQ(run.events.empty(), world().size() == 1);
}

TEST(SpaceFocus, has_the_bits_of_the_whole_world_where_islands_sleep) {
  model::Model model = followed_ball();
  model.effects["sleeping"] = true;
  model.sleep.after_s = 0.2;
  const SharedModel shared = share(model);
  const WorldRunSettings settings = space_settings(60);
  EXPECT_EQ(run_spaces(world(), shared, settings, testing_support::ode_steps, Oracle::none).result.state_hash,
            whole_hash(shared, settings));
}

TEST(SpaceFocus, has_the_bits_of_a_world_without_where_it_holds_everything) {
  model::Model model = followed_ball();
  model.interest->radius_m = 1000;
  WorldRunSettings settings = space_settings();
  const std::uint64_t expected = whole_hash(share(neighbours()), settings);
  EXPECT_EQ(run_spaces(world(), share(model), settings).result.state_hash, expected);
  EXPECT_NE(run_spaces(world(), share(followed_ball()), settings).result.state_hash, expected);
}

// Where bodies cannot cross, a rank learns only from the owner where the body is that the field follows.
TEST(SpaceFocus, has_the_bits_of_the_whole_world_where_spaces_never_meet) {
  model::Model model = followed_ball();
  model.events.clear();
  model.spaces_meet = false;
  for (std::size_t i = 0; i < model.bodies.size(); ++i)
    model.bodies[i].pose.position.y() += 4.0 * model.geoms[i + 1].space;
  model.bodies.back().velocity = {-6, -8, 0};  // parallel to the others, at a distance
  model.interest->radius_m = 5;
  const SharedModel shared = share(model);
  const WorldRunSettings settings = space_settings(10);
  const SpaceRun run = run_spaces(world(), shared, settings, testing_support::ode_steps, Oracle::none);
  EXPECT_EQ(run.result.failure, "");
  EXPECT_EQ(run.result.state_hash, whole_hash(shared, settings));
}

TEST(SpaceFocus, counts_the_bodies_inside_as_the_whole_world_does) {
  for (const bool sleeping : {false, true}) {
    model::Model model = followed_ball();
    if (sleeping) model.effects["sleeping"] = true;
    const SharedModel shared = share(model);
    const WorldRunSettings settings = space_settings(40);
    const auto worlds = solver::make_sor_stepper(
        default_settings(stepping::StepperKind::sor, stepping::Law::ode), ode::make_narrow_phase);
    WorldDriver whole(
        Communicator(), *worlds, [&](int) { return shared; }, settings);
    const std::vector<int> expected = inside_of(whole);
    EXPECT_GE(std::set<int>(expected.begin(), expected.end()).size(), 3u) << "the field moves over the world";
    const auto spaces = make_space_stepper(shared);
    SpaceDriver cut(world(), *spaces, settings);
    const std::vector<int> inside = inside_of(cut);
    EXPECT_EQ(inside, world().is_root() ? expected : std::vector<int>());
  }
}

// A field that stands still needs no message; one that moves needs one message per step to each other rank.
TEST(SpaceFocus, sends_no_message_for_a_center_that_stands) {
  WorldRunSettings settings = space_settings();
  settings.rebalance_threshold = model::infinity;
  const int last = world().size() - 1;
  settings.placement = {0, last, last, last};
  const auto messages = [&](model::Model model) {
    const auto run =
        run_spaces(world(), share(std::move(model)), settings, testing_support::ode_steps, Oracle::none);
    return run.messages;
  };
  model::Model all = neighbours();  // the same bits in all three, hence the same islands that cross
  const std::int64_t plain = messages(all);
  all.interest = model::Interest{{0, 0, 0}, model::no_body, 1000, 3};
  EXPECT_EQ(messages(all), plain);
  all.interest->follows = 0;  // in the space of root
  const std::int64_t steps = 3 * (settings.warmup + settings.frames);
  EXPECT_EQ(messages(all), plain + (world().is_root() ? steps * (world().size() - 1) : 0));
}

}  // namespace
}  // namespace pbmpi::mpi
