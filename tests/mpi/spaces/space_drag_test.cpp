// The effect "drag" in a world cut into spaces.
#include <gtest/gtest.h>

#include "space_run.h"

namespace pbmpi::mpi {
namespace {

using testing_support::expect_whole_in_placements;
using testing_support::neighbours;
using testing_support::Oracle;
using testing_support::run_spaces;
using testing_support::share;
using testing_support::SharedModel;
using testing_support::shoot_out;
using testing_support::space_settings;
using testing_support::whole_hash;
using testing_support::world;

model::Model in_thick_air(model::Model model) {
  model.air_density = 20;
  return model;
}

// Root, too, sees the fast bodies of other ranks slowed down before it looks for their speculative contacts.
TEST(SpaceDrag, has_the_bits_of_the_whole_world_for_every_ownership) {
  for (const SharedModel& model : {share(in_thick_air(neighbours())), share(in_thick_air(shoot_out()))})
    expect_whole_in_placements(model, 20, 23);
}

TEST(SpaceDrag, has_the_bits_of_the_whole_world_where_islands_sleep) {
  model::Model model = in_thick_air(shoot_out());
  model.effects["sleeping"] = true;
  model.sleep.after_s = 0.2;
  const SharedModel shared = share(model);
  const WorldRunSettings settings = space_settings(60);
  EXPECT_EQ(run_spaces(world(), shared, settings, testing_support::ode_steps, Oracle::none).result.state_hash,
            whole_hash(shared, settings));
}

TEST(SpaceDrag, changes_the_result) {
  const WorldRunSettings settings = space_settings();
  EXPECT_NE(whole_hash(share(in_thick_air(neighbours())), settings),
            whole_hash(share(neighbours()), settings));
}

}  // namespace
}  // namespace pbmpi::mpi
