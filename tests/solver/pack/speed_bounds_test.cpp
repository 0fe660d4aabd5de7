// Which worlds of a pack may have a fast body: the same result as body by body, for every instruction set.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "core/random.h"
#include "effects/fast_bodies.h"
#include "solver/layout/articulation.h"
#include "solver/pack/simd.h"
#include "solver/sor_run.h"
#include "support/models.h"
#include "support/slow_bounds.h"

namespace pbmpi::solver {
namespace {

constexpr double dt_s = 0.01;
constexpr int num_worlds = 37;  // the last batch of every width has idle lanes

/// Boxes and a ball that stay well within their bounds; in every other world one moves or turns by up to 30 %
/// less or more than its bound.
model::Model model_of(int world) {
  model::Model model;
  const int actor = support::add_actor(model, "things");
  for (int i = 0; i < 3; ++i) {
    const auto shape = i == 1 ? model::Shape::sphere : model::Shape::box;
    const int body = support::add_solid(model, actor, "thing" + std::to_string(i), shape, {0.2, 0.3, 0.4}, 1,
                                        {1.0 * i, 0, 1});
    model.bodies[static_cast<std::size_t>(body)].velocity = {0.1, 0, -0.1};
  }
  model.geoms[2].local.position = {0, 0.3, 0};
  const bool turns = world % 4 == 2;
  const std::size_t which = turns ? 2 : static_cast<std::size_t>(world % 3);
  const effects::SlowBound bound = effects::slow_bounds(model)[which];
  const double excess = 0.01 + 0.29 * core::to_unit(core::mix_key(3, static_cast<std::uint64_t>(world), 0));
  const double share = world / 4 % 2 == 0 ? 1 + excess : 1 - excess;
  if (world % 4 == 1) model.bodies[which].velocity = core::Vec3(0, share * bound.way_m / dt_s, 0);
  if (turns) model.bodies[which].angular_velocity = core::Vec3(0, 0, share * bound.turn_rad / dt_s);
  return model;
}

TEST(SpeedBounds, tell_the_worlds_in_which_a_body_does_not_keep_its_own) {
  std::vector<model::Model> models;
  for (int world = 0; world < num_worlds; ++world) models.push_back(model_of(world));
  std::vector<PackedWorld> worlds;
  std::vector<char> expected;
  for (const model::Model& model : models) {
    worlds.push_back({&model, find_articulations(model)});
    expected.push_back(support::keeps_slow_bounds(model, dt_s) ? 0 : 1);
  }
  ASSERT_GT(std::count(expected.begin(), expected.end(), 1), 8);
  ASSERT_GT(std::count(expected.begin(), expected.end(), 0), 20);
  for (const stepping::Simd simd : machine_simds()) {
    for (const stepping::Precision precision : {stepping::Precision::double_, stepping::Precision::single}) {
      const auto pack = make_pack(worlds, simd, precision);
      std::vector<char> found;
      pack->find_fast(dt_s, found);
      EXPECT_EQ(found, expected) << static_cast<int>(simd);
      pack->find_fast(dt_s / 10, found);
      EXPECT_EQ(found, std::vector<char>(num_worlds, 0)) << "of a shorter step none is";
    }
  }
}

TEST(SpeedBounds, take_a_world_that_is_lost_for_slow) {
  std::vector<model::Model> models = {model_of(0), model_of(0)};
  const double nan = std::numeric_limits<double>::quiet_NaN();
  models[0].bodies[0].velocity = {nan, nan, nan};
  const std::vector<PackedWorld> worlds = {{&models[0], find_articulations(models[0])},
                                           {&models[1], find_articulations(models[1])}};
  for (const stepping::Simd simd : machine_simds()) {
    std::vector<char> found;
    make_pack(worlds, simd, stepping::Precision::double_)->find_fast(dt_s, found);
    EXPECT_EQ(found, std::vector<char>(2, 0));
  }
}

}  // namespace
}  // namespace pbmpi::solver
