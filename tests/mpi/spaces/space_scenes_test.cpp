/// Every built-in scene with several spaces, over 60 frames, with the brute-force oracle in each step.

#include <gtest/gtest.h>

#include "scenes/scene.h"
#include "space_run.h"

namespace pbmpi::mpi {
namespace {

using testing_support::run_spaces;
using testing_support::space_settings;
using testing_support::SpaceRun;
using testing_support::whole_hash;

class SpaceScenes : public testing::TestWithParam<const char*> {};

TEST_P(SpaceScenes, have_the_contacts_and_the_bits_of_the_undecomposed_world) {
  const Communicator comm = Communicator::world();
  const auto scene = scenes::parse_scene(scenes::find_scene(GetParam()));
  const auto model = scene->build(0, 1);
  ASSERT_GT(model->spaces.size(), 1u);
  const auto settings = space_settings(58);  // and 2 of warm-up
  const SpaceRun run = run_spaces(comm, model, settings);
  EXPECT_EQ(run.result.frames_done, 60);
  EXPECT_EQ(run.result.state_hash, whole_hash(model, settings));
  EXPECT_TRUE(run.contacts_checked > 10 * 180 || !comm.is_root()) << "a scene of PhysicsBench has contacts";
}

INSTANTIATE_TEST_SUITE_P(PhysicsBench, SpaceScenes,
                         testing::Values("CrashWa", "Environ", "Battle", "Fight", "Battle2"),
                         [](const auto& test) { return std::string(test.param); });

}  // namespace
}  // namespace pbmpi::mpi
