#include "mpi/spaces/plan/initial_owners.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "mpi/balance/partition.h"

namespace pbmpi::mpi {
namespace {

using core::Vec3;

struct Town {
  std::vector<double> cost;
  std::vector<Vec3> centre;
  std::vector<int> compound;  ///< of each space
};

/// Compounds 60 m apart in rows of `side`, their spaces dealt in turn, each of a large space and six small
/// ones.
Town town_of(int compounds, int side) {
  Town town;
  for (int space = 0; space < 7; ++space) {
    for (int compound = 0; compound < compounds; ++compound) {
      town.cost.push_back(space == 0 ? 10 : 1 + space % 3);
      town.centre.push_back(
          {60.0 * (compound % side) + 3 * space, 60.0 * (compound / side) - 2 * space, 0.5 * space});
      town.compound.push_back(compound);
    }
  }
  return town;
}

double largest_load(const Town& town, const std::vector<int>& owner, int num_ranks) {
  return std::ranges::max(rank_loads(owner, town.cost, num_ranks));
}

TEST(InitialOwners, give_each_rank_compounds_that_lie_together) {
  const Town town = town_of(16, 4);
  for (const int num_ranks : {1, 2, 4, 8, 16}) {
    const std::vector<int> owner = owners_by_place(town.cost, town.centre, num_ranks);
    std::vector<std::set<int>> ranks(16);
    for (std::size_t space = 0; space < owner.size(); ++space)
      ranks[town.compound[space]].insert(owner[space]);
    for (const std::set<int>& of_compound : ranks) EXPECT_EQ(of_compound.size(), 1u) << num_ranks << " ranks";
    EXPECT_DOUBLE_EQ(largest_load(town, owner, num_ranks), 16 / num_ranks * 22);
  }
}

// Eleven ranks cannot have whole compounds; what then counts is the load.
TEST(InitialOwners, leave_no_rank_with_more_than_place_is_worth) {
  const Town town = town_of(16, 4);
  for (const int num_ranks : {3, 5, 7, 11}) {
    const std::vector<int> owner = owners_by_place(town.cost, town.centre, num_ranks);
    const double by_cost = largest_load(town, lpt_placement(town.cost, num_ranks), num_ranks);
    EXPECT_LE(largest_load(town, owner, num_ranks), std::max(by_cost, 1.1 * 16 * 22 / num_ranks))
        << num_ranks;
    EXPECT_EQ(std::set<int>(owner.begin(), owner.end()).size(), static_cast<std::size_t>(num_ranks));
  }
}

TEST(InitialOwners, are_by_cost_alone_where_no_plane_balances) {
  // The middle one of three is as large as both others.
  const std::vector<double> cost = {1, 2, 1};
  const std::vector<Vec3> centre = {{0, 0, 0}, {5, 0, 0}, {10, 0, 0}};
  EXPECT_EQ(owners_by_place(cost, centre, 2), lpt_placement(cost, 2));
}

TEST(InitialOwners, take_any_numbers) {
  EXPECT_EQ(owners_by_place({}, {}, 3), std::vector<int>());
  const std::vector<double> nothing = {0, 0};
  const std::vector<Vec3> same(2, Vec3::Zero());
  for (const int owner : owners_by_place(nothing, same, 2)) EXPECT_LT(owner, 2);
  for (const int owner : owners_by_place(nothing, same, 5)) EXPECT_LT(owner, 5);
}

}  // namespace
}  // namespace pbmpi::mpi
