#include "stepping/deadline_plan.h"

#include <gtest/gtest.h>

#include <cmath>

#include "stepping/glide.h"

namespace pbmpi::stepping {
namespace {

TEST(DeadlinePlan, counts_on_the_slowest_of_the_last_three_frames_and_leaves_a_tenth) {
  DeadlinePlan plan(10);
  EXPECT_TRUE(plan.fits(8.9, 1000, 1000)) << "nothing is known yet";
  EXPECT_FALSE(plan.fits(9.1, 0, 0)) << "the time is up";
  plan.note_precise(2);
  plan.note_coarse(0.5);
  EXPECT_TRUE(plan.fits(0, 4, 2));
  EXPECT_FALSE(plan.fits(0, 4, 3));
  plan.note_precise(4);
  EXPECT_FALSE(plan.fits(0, 3, 0));
  for (int frame = 0; frame < 2; ++frame) plan.note_precise(1);
  EXPECT_FALSE(plan.fits(0, 3, 0)) << "the slow frame is one of the last three";
  plan.note_precise(1);
  EXPECT_TRUE(plan.fits(0, 9, 0)) << "it is no longer";
}

TEST(DeadlinePlan, a_slow_coarse_step_is_forgotten_though_none_follows) {
  DeadlinePlan plan(10);
  EXPECT_NO_THROW(plan.skip_coarse());
  plan.note_coarse(100);
  for (int frame = 0; frame < 22; ++frame) plan.skip_coarse();
  EXPECT_FALSE(plan.fits(0, 0, 1)) << "100 x 0.9^22 = 9.8";
  plan.skip_coarse();
  EXPECT_TRUE(plan.fits(0, 0, 1)) << "100 x 0.9^23 = 8.9";
}

TEST(Glide, moves_by_h_v_and_turns_by_the_angular_velocity) {
  model::State state;
  state.resize(1);
  state.position[0] = {1, 2, 3};
  state.orientation[0] = {};
  state.velocity[0] = {10, 0, -1};
  state.angular_velocity[0] = {0, 0, 2};
  glide(0.03, state);
  EXPECT_EQ(state.position[0], core::Vec3(1 + 0.03 * 10, 2, 3 - 0.03));
  // q + h/2 w q has the angle 2 atan(h w / 2).
  EXPECT_NEAR(2 * std::atan2(state.orientation[0].z, state.orientation[0].w), 2 * std::atan(0.03), 1e-15);
  EXPECT_NEAR(
      state.orientation[0].w * state.orientation[0].w + state.orientation[0].z * state.orientation[0].z, 1,
      1e-15);
  EXPECT_EQ(state.velocity[0], core::Vec3(10, 0, -1));
}

}  // namespace
}  // namespace pbmpi::stepping
