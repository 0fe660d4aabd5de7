#include "stepping/observable_table.h"

#include <gtest/gtest.h>

#include <limits>
#include <set>

#include "support/models.h"

namespace pbmpi::stepping {
namespace {

TEST(ObservableTable, has_each_name_once) {
  std::set<std::string_view> names;
  for (const WorldColumn& column : world_observables)
    EXPECT_TRUE(names.insert(column.name).second) << column.name;
}

TEST(ObservableTable, finds_the_column_of_a_member) {
  EXPECT_EQ(world_observables[column_of(&Observables::energy_j)].name, "energy");
  EXPECT_EQ(world_observables[column_of(&Observables::contacts)].name, "contacts");
}

TEST(ObservableTable, reads_counts_and_measures_as_numbers) {
  Observables seen;
  seen.rows = 7;
  seen.joint_gap_m = 0.25;
  EXPECT_EQ(number_of(seen, world_observables[column_of(&Observables::rows)]), 7);
  EXPECT_EQ(number_of(seen, world_observables[column_of(&Observables::joint_gap_m)]), 0.25);
}

TEST(ObservableTable, joins_what_ranks_have_seen_of_one_world) {
  Observables all, part;
  all.contacts = 3;
  all.max_island_rows = 12;
  all.joint_gap_m = 0.5;
  part.contacts = 4;
  part.max_island_rows = 9;
  part.joint_gap_m = 0.75;
  part.bodies_inside = 2;
  join(all, part);
  EXPECT_EQ(all.contacts, 7) << "a sum";
  EXPECT_EQ(all.max_island_rows, 12) << "the larger one";
  EXPECT_EQ(all.joint_gap_m, 0.75);
  EXPECT_EQ(all.bodies_inside, 2);
}

TEST(ObservableTable, joins_vectors_by_component) {
  Observables all, part;
  all.linear_momentum = {1, 2, 3};
  part.linear_momentum = {10, -20, 30};
  join(all, part);
  EXPECT_EQ(all.linear_momentum, (std::array<double, 3>{11, -18, 33}));
}

TEST(ObservableTable, joins_no_numbers_to_zero) {
  EXPECT_EQ(join(Join::sum, {}), 0);
  EXPECT_EQ(join(Join::max, {}), 0);
  const std::array<double, 3> numbers = {2, 5, 1};
  EXPECT_EQ(join(Join::sum, numbers), 8);
  EXPECT_EQ(join(Join::max, numbers), 5);
}

TEST(Observables, of_a_world_that_sleeps_keep_what_follows_from_its_state) {
  Observables seen;
  seen.contacts = seen.rows = seen.islands = seen.max_island_rows = seen.fast_bodies = seen.bodies_inside = 5;
  seen.max_penetration_m = seen.joint_gap_m = seen.energy_j = 0.5;
  observe_sleep(seen);
  EXPECT_EQ(seen.contacts + seen.rows + seen.max_island_rows + seen.fast_bodies + seen.bodies_inside, 0);
  EXPECT_EQ(seen.max_penetration_m, 0);
  EXPECT_EQ(seen.islands, 5);
  EXPECT_EQ(seen.joint_gap_m, 0.5);
  EXPECT_EQ(seen.energy_j, 0.5);
}

TEST(Observables, that_are_not_finite_are_named) {
  Observables seen;
  EXPECT_EQ(first_not_finite(seen), "");
  seen.residuals.natural_turn = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(first_not_finite(seen), "natural_turn");
  seen.angular_momentum[2] = -std::numeric_limits<double>::infinity();
  EXPECT_EQ(first_not_finite(seen), "angular_momentum");
  seen.energy_j = std::numeric_limits<double>::infinity();
  EXPECT_EQ(first_not_finite(seen), "energy");
}

TEST(Observables, of_a_state_are_zero_gap_without_joints_and_count_broken_numbers) {
  const model::Model model = support::free_box();
  model::State state = model::initial_state(model);
  Observables seen;
  observe_state(model, state, seen);
  EXPECT_EQ(seen.joint_gap_m, 0);
  EXPECT_EQ(seen.nonfinite, 0);
  state.velocity[0].x() = std::numeric_limits<double>::quiet_NaN();
  observe_state(model, state, seen);
  EXPECT_EQ(seen.nonfinite, 1);
}

}  // namespace
}  // namespace pbmpi::stepping
