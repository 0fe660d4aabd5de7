#include "effects/space_sleepers.h"

#include <gtest/gtest.h>

#include "support/models.h"

namespace pbmpi::effects {
namespace {

/// Two cubes, each owned by a rank, as seen by one rank.
struct Rank {
  model::Model model = support::pile(2);
  model::State state = model::initial_state(model);
  SpaceSleepers sleepers{model, 0.01, state};
  Rank() { sleepers.start(); }
};

constexpr int steps_of_rest = 50;

bool undriven(int) { return false; }

TEST(SpaceSleepers, count_for_the_bodies_that_they_are_asked_for) {
  Rank rank;
  const std::vector<int> own = {1};
  for (int step = 0; step < steps_of_rest - 1; ++step)
    EXPECT_TRUE(rank.sleepers.find_resting(own, {}, undriven).empty());
  const std::vector<Resting> resting = rank.sleepers.find_resting(own, {}, undriven);
  ASSERT_EQ(resting.size(), 1u);
  EXPECT_EQ(resting[0].body, 1);
  EXPECT_EQ(rank.state.rest[0].idle_steps, 0) << "the other rank's";
}

TEST(SpaceSleepers, go_on_with_rows_that_came_from_the_last_owner) {
  Rank first, second;
  const std::vector<int> both = {0, 1};
  for (int step = 0; step < steps_of_rest - 1; ++step) first.sleepers.find_resting(both, {}, undriven);
  second.sleepers.put(both, first.sleepers.rest_rows(both));
  EXPECT_EQ(second.sleepers.find_resting(both, {}, undriven).size(), 2u);
  first.sleepers.put_to_sleep(std::vector<Resting>{{0, 0}, {1, 0}});
  second.sleepers.put(both, first.sleepers.rest_rows(both));
  EXPECT_TRUE(second.sleepers.all_asleep());
  EXPECT_EQ(second.sleepers.island(1), 0);
}

TEST(SpaceSleepers, tell_by_a_revision_that_a_body_woke_or_fell_asleep) {
  Rank rank;
  const long awake = rank.sleepers.revision();
  EXPECT_FALSE(rank.sleepers.wake(std::vector<int>{}));
  rank.sleepers.put_to_sleep({});
  EXPECT_EQ(rank.sleepers.revision(), awake);
  rank.sleepers.put_to_sleep(std::vector<Resting>{{1, 1}});
  const long asleep = rank.sleepers.revision();
  EXPECT_NE(asleep, awake);
  EXPECT_TRUE(rank.sleepers.wake(std::vector<int>{1}));
  EXPECT_NE(rank.sleepers.revision(), asleep);
}

}  // namespace
}  // namespace pbmpi::effects
