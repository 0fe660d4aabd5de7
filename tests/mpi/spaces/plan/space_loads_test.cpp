#include "mpi/spaces/plan/space_loads.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "mpi/spaces/plan/load_ledger.h"
#include "mpi/spaces/plan/reassign_spaces.h"

namespace pbmpi::mpi {
namespace {

/// Spaces with these numbers of equal units; a batch of `lanes` units takes one second, collision none.
SpaceLoads spaces_of(const std::vector<int>& units, int lanes = 1) {
  SpaceLoads loads;
  loads.num_lanes = lanes;
  loads.batch_s = {1};
  for (const int count : units) {
    loads.inside.push_back({{count}, 0, count});
    loads.collide_s.push_back(0);
  }
  return loads;
}

std::vector<int> owners_after(const SpaceLoads& loads, std::vector<int> owner, int num_ranks,
                              double threshold = 1.1) {
  for (const Move& move : reassign_spaces(loads, owner, num_ranks, threshold).moves)
    owner[move.part] = move.to;
  return owner;
}

double makespan(const SpaceLoads& loads, const std::vector<int>& owner, int num_ranks) {
  return predict_loads(loads, owner, num_ranks).makespan_s();
}

TEST(SpaceLoads, counts_full_batches_of_lanes) {
  const SpaceLoads loads = spaces_of({5, 5}, 8);
  EXPECT_EQ(makespan(loads, {0, 0}, 2), 2);  // ten units fill two batches of eight
  EXPECT_EQ(makespan(loads, {0, 1}, 2), 1);
}

TEST(SpaceLoads, puts_an_island_on_the_rank_with_most_of_its_bodies_and_ships_the_rest) {
  SpaceLoads loads = spaces_of({4, 4});
  loads.ship_s = 0.1;
  loads.islands = {{{0, {{3}, 0, 3}}, {1, {{1}, 0, 1}}}};
  const PredictedLoads apart = predict_loads(loads, std::vector<int>{0, 1}, 2);
  EXPECT_TRUE(apart.ships);
  EXPECT_DOUBLE_EQ(apart.ranks[0].solve_s, 4 + 4 + 0.1);
  EXPECT_DOUBLE_EQ(apart.ranks[1].solve_s, 4 + 0.1);
  const PredictedLoads together = predict_loads(loads, std::vector<int>{1, 1}, 2);
  EXPECT_FALSE(together.ships);
  EXPECT_DOUBLE_EQ(together.ranks[1].solve_s, 12);
}

TEST(SpaceLoads, lets_ranks_wait_between_solving_and_colliding_only_where_something_is_shipped) {
  SpaceLoads loads = spaces_of({3, 1});
  loads.collide_s = {1, 3};
  EXPECT_EQ(makespan(loads, {0, 1}, 2), 4);
  loads.islands = {{{0, {{1}, 0, 1}}, {1, {{0}, 0, 0}}}};
  EXPECT_EQ(makespan(loads, {0, 1}, 2), 3 + 4);
}

TEST(SpaceLoads, evens_out_by_moves_and_swaps) {
  const SpaceLoads loads = spaces_of({8, 4, 3, 1});
  EXPECT_EQ(makespan(loads, owners_after(loads, {0, 0, 0, 0}, 2), 2), 8);
  EXPECT_EQ(makespan(loads, owners_after(loads, {0, 0, 1, 1}, 2), 2), 8);
}

// Sixteen towns of a large space and fourteen small ones. Where several ranks take longest, no move of one
// space makes the frame shorter by itself.
TEST(SpaceLoads, evens_out_many_spaces_over_many_ranks) {
  constexpr int towns = 16, spaces_of_town = 15, ranks = 16;
  SpaceLoads loads = spaces_of({});
  double sum = 0;
  for (int space = 0; space < towns * spaces_of_town; ++space) {
    const int units = space % spaces_of_town == 0 ? 40 : 3 + space * 7 % 11;
    loads.inside.push_back({{units}, 0, units});
    loads.collide_s.push_back(0.1 * (space % 9));
    sum += units + loads.collide_s.back();
  }
  std::vector<int> on_root(loads.inside.size(), 0), dealt;
  for (std::size_t space = 0; space < loads.inside.size(); ++space)
    dealt.push_back(static_cast<int>(space) % ranks);
  for (const std::vector<int>& owner : {on_root, dealt})
    EXPECT_LE(makespan(loads, owners_after(loads, owner, ranks), ranks), 1.02 * sum / ranks);
}

TEST(SpaceLoads, gives_root_less_where_its_section_takes_time) {
  SpaceLoads loads = spaces_of({2, 2, 2, 2});
  loads.root_extra_s = 4;
  const std::vector<int> owner = owners_after(loads, {0, 0, 1, 1}, 2);
  EXPECT_EQ(std::count(owner.begin(), owner.end(), 0), 1);
  EXPECT_EQ(std::count(owner.begin(), owner.end(), 1), 3);
}

TEST(SpaceLoads, lets_root_and_another_rank_change_places) {
  SpaceLoads loads = spaces_of({10, 3, 3, 3});
  loads.root_extra_s = 2;
  const std::vector<int> owner = owners_after(loads, {0, 1, 1, 1}, 2, 1);
  EXPECT_EQ(owner, (std::vector<int>{1, 0, 0, 0})) << "no move or swap of single spaces helps";
  EXPECT_EQ(makespan(loads, owner, 2), 11);
}

TEST(SpaceLoads, brings_the_spaces_of_an_island_together) {
  SpaceLoads loads = spaces_of({1, 1, 4, 4});
  loads.ship_s = 0.2;
  loads.islands = {{{0, {{2}, 0, 2}}, {1, {{2}, 0, 2}}}};
  const std::vector<int> owner = owners_after(loads, {0, 1, 0, 1}, 2);
  EXPECT_EQ(owner[0], owner[1]);
  EXPECT_EQ(makespan(loads, owner, 2), 8);
}

// Two ranks with two compounds each; one space more would even them out, but root would look at its compound.
TEST(SpaceLoads, leaves_neighbours_together_where_root_would_have_to_look_at_them) {
  SpaceLoads loads = spaces_of({4, 4, 4, 2, 2, 2});
  for (int space = 0; space < 6; ++space) {
    loads.borders.push_back({.bodies = 10, .neighbours = {}});
    for (int other = space / 3 * 3; other < space / 3 * 3 + 3; ++other) {
      if (other != space) loads.borders.back().neighbours.push_back(other);
    }
  }
  const std::vector<int> whole = {0, 0, 0, 1, 1, 1};
  loads.cross_s = 0.2;
  EXPECT_EQ(makespan(loads, {0, 0, 1, 1, 1, 1}, 2), 8 + 0.2 * 30);
  EXPECT_EQ(owners_after(loads, whole, 2), whole);
  loads.cross_s = 0.01;
  EXPECT_LE(makespan(loads, owners_after(loads, whole, 2), 2), 10.3) << "it costs less than it gains";
}

// Weights and costs are small integers, so the fit is exact up to the rounding of a division.
TEST(SolverCosts, are_found_from_ranks_that_differ) {
  const SolverCosts costs =
      fit_costs(std::vector<RankSample>{{10, 2, 10 * 1 + 2 * 3}, {4, 8, 4 * 1 + 8 * 3}});
  EXPECT_DOUBLE_EQ(costs.batches, 1);
  EXPECT_DOUBLE_EQ(costs.contacts, 3);
}

TEST(SolverCosts, are_the_same_where_the_ranks_are_alike_or_have_nothing) {
  const SolverCosts alike = fit_costs(std::vector<RankSample>{{10, 5, 30}, {20, 10, 60}});
  EXPECT_DOUBLE_EQ(alike.batches, 2);
  EXPECT_DOUBLE_EQ(alike.contacts, 2);
  const SolverCosts one_kind = fit_costs(std::vector<RankSample>{{0, 5, 15}, {0, 10, 30}});
  EXPECT_DOUBLE_EQ(one_kind.contacts, 3);
  EXPECT_EQ(fit_costs(std::vector<RankSample>{{0, 0, 1}, {0, 0, 2}}).batches, 0);
}

TEST(SolverCosts, stay_within_four_times_the_mean_whatever_a_frame_says) {
  const SolverCosts costs = fit_costs(std::vector<RankSample>{{10, 1, 100}, {1, 10, 1}});
  EXPECT_DOUBLE_EQ(costs.contacts, 101.0 / 22 / 4) << "the fit alone gives less than 0";
}

TEST(SpaceLoads, stays_if_too_little_is_to_be_gained) {
  const SpaceLoads loads = spaces_of({102, 98, 1});
  EXPECT_TRUE(reassign_spaces(loads, std::vector<int>{0, 1, 0}, 2, 1.1).moves.empty());
  EXPECT_FALSE(reassign_spaces(loads, std::vector<int>{0, 0, 0}, 2, 1.1).moves.empty());
  EXPECT_TRUE(reassign_spaces(loads, std::vector<int>{0, 0, 0}, 2, std::numeric_limits<double>::infinity())
                  .moves.empty());
}

TEST(SpaceLoads, never_makes_it_worse_and_tells_what_it_promises) {
  for (int code = 0; code < 243; ++code) {
    const SpaceLoads loads = spaces_of({7, 5, 4, 2, 1}, 2);
    const std::vector<int> owner = {code % 3, code / 3 % 3, code / 9 % 3, code / 27 % 3, code / 81 % 3};
    const Reassignment found = reassign_spaces(loads, owner, 3, 1);
    EXPECT_EQ(found.makespan_before_s, makespan(loads, owner, 3));
    EXPECT_LE(found.makespan_after_s, found.makespan_before_s);
    EXPECT_EQ(found.makespan_after_s, makespan(loads, owners_after(loads, owner, 3, 1), 3));
    EXPECT_LE(found.makespan_after_s, 5) << "the best is 4; single changes may end a batch above it";
  }
}

}  // namespace
}  // namespace pbmpi::mpi
