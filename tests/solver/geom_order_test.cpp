#include "solver/layout/geom_order.h"

#include <gtest/gtest.h>

#include "support/models.h"

namespace pbmpi::solver {
namespace {

model::Model spheres(int count) {
  model::Model model;
  for (int i = 0; i < count; ++i) {
    const std::string name = "sphere" + std::to_string(i);
    support::add_solid(model, support::add_actor(model, name), name, model::Shape::sphere, {0.5, 0, 0}, 1,
                       {2.0 * i, 0, 0});
  }
  return model;
}

TEST(GeomOrder, puts_the_swept_geoms_of_each_world_in_front) {
  const model::Model three = spheres(3), five = spheres(5);
  PackedWorld whole, part;
  whole.model = &three;
  part.model = &five;
  part.swept_geoms = {1, 4};
  const std::vector<PackedWorld> worlds = {whole, part};
  const GeomOrder order(worlds);
  EXPECT_EQ(order.num_columns(), 16 + 5) << "a world begins where a line of the cache does";
  EXPECT_EQ(std::vector<int>(order.swept(0).begin(), order.swept(0).end()), (std::vector<int>{0, 1, 2}));
  EXPECT_EQ(std::vector<int>(order.swept(1).begin(), order.swept(1).end()), (std::vector<int>{1, 4}));
  EXPECT_EQ(order.first(1), 16);
  std::vector<int> columns;
  for (int geom = 0; geom < 5; ++geom) columns.push_back(order.column(1, geom));
  EXPECT_EQ(columns, (std::vector<int>{18, 16, 19, 20, 17}));
}

TEST(GeomOrder, names_each_chunk_once) {
  const model::Model model = spheres(9);
  PackedWorld part;
  part.model = &model;
  part.swept_geoms = {2, 3, 8};
  const GeomOrder order(std::span(&part, 1));
  EXPECT_EQ(order.swept_chunks(2), (std::vector<int>{0, 1}));
  EXPECT_EQ(order.swept_chunks(4), (std::vector<int>{0}));
  std::vector<int> chunks;
  // After the swept geoms, 0, 1, 4, 5, 6, 7 are in columns 3 to 8.
  order.find_chunks(0, std::vector<model::GeomPair>{{0, 2}, {2, 7}}, 4, chunks);
  EXPECT_EQ(chunks, (std::vector<int>{0, 2}));
}

}  // namespace
}  // namespace pbmpi::solver
