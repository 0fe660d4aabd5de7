/// The nine scenes of the paper.
#include <gtest/gtest.h>

#include "mujoco/mujoco_stepper.h"
#include "scenes/scene.h"
#include "simulation.h"

namespace pbmpi::mujoco {
namespace {

struct Case {
  const char* scene;
  int num_steps;
};

/// Newton's solver factorises a world as a whole: a step of the largest two takes seconds to minutes, and 2
/// GB.
const Case cases[] = {{"2-Cars", 30},  {"10-Cars", 30}, {"CrashSk", 30}, {"100CrSk", 30}, {"Fight", 30},
                      {"CrashWa", 30}, {"Battle", 30},  {"Environ", 0},  {"Battle2", 0}};

class MujocoScenes : public testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(Nine, MujocoScenes, testing::ValuesIn(cases));

TEST_P(MujocoScenes, stay_finite_with_their_joints_closed) {
  const auto [name, num_steps] = GetParam();
  const auto model = scenes::parse_scene(scenes::find_scene(name), 0.01)->build(0, 1);
  EXPECT_TRUE(refusals(*model).empty());
  const auto stepper = make_mujoco_stepper(settings_with());
  stepper->add(0, model, model::initial_state(*model), 0);
  core::PhaseTimes times;
  stepper->advance(num_steps, times);
  EXPECT_EQ(stepper->observables(0).nonfinite, 0);
  EXPECT_LT(stepper->observables(0).joint_gap_m, 1e-9);
  EXPECT_LT(stepper->observables(0).max_penetration_m, 0.1);
}

}  // namespace
}  // namespace pbmpi::mujoco
