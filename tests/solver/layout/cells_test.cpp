#include "solver/layout/cells.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>

#include "support/models.h"

namespace pbmpi::solver {
namespace {

/// Balls in clusters of `size` along x, 10 m apart.
model::Model clusters(int count, int size) {
  model::Model model;
  const int actor = support::add_actor(model, "balls", model::ActorKind::wall, true);
  for (int i = 0; i < count * size; ++i) {
    const double x = 10.0 * (i / size) + 0.1 * (i % size);
    support::add_solid(model, actor, "ball" + std::to_string(i), model::Shape::sphere, {0.04, 0, 0}, 1,
                       {x, 0, 1});
  }
  return model;
}

std::vector<int> cells_of(const model::Model& model, int most_bodies) {
  return find_cells(model, find_articulations(model), most_bodies);
}

TEST(FindCells, leaves_a_world_whole_that_is_small_enough) {
  EXPECT_EQ(cells_of(clusters(2, 5), 10), std::vector<int>(10, 0));
  EXPECT_TRUE(cells_of(model::Model(), 10).empty());
}

TEST(FindCells, cuts_between_clusters) {
  const std::vector<int> cells = cells_of(clusters(8, 5), 7);
  for (int cluster = 0; cluster < 8; ++cluster) {
    for (int i = 1; i < 5; ++i)
      EXPECT_EQ(cells[static_cast<std::size_t>(5 * cluster)],
                cells[static_cast<std::size_t>(5 * cluster + i)]);
  }
  EXPECT_EQ(std::set<int>(cells.begin(), cells.end()).size(), 8U);
}

TEST(FindCells, keeps_to_the_most_bodies_and_numbers_cells_without_gaps) {
  const std::vector<int> cells = cells_of(clusters(1, 100), 9);
  const int count = *std::ranges::max_element(cells) + 1;
  for (int cell = 0; cell < count; ++cell) {
    EXPECT_GT(std::ranges::count(cells, cell), 0) << cell;
    EXPECT_LE(std::ranges::count(cells, cell), 9) << cell;
  }
}

TEST(FindCells, cuts_no_articulation) {
  const std::vector<int> cells = cells_of(support::chain(12), 5);
  EXPECT_EQ(cells, std::vector<int>(cells.size(), 0));
}

TEST(FindCells, cuts_what_lies_in_one_place) {
  model::Model model = clusters(1, 20);
  for (model::Body& body : model.bodies) body.pose.position = {1, 2, 3};
  const std::vector<int> cells = cells_of(model, 4);
  for (const int cell : cells) EXPECT_LE(std::ranges::count(cells, cell), 4) << cell;
}

}  // namespace
}  // namespace pbmpi::solver
