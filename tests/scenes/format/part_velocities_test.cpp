#include "scenes/format/part_velocities.h"

#include <gtest/gtest.h>

#include "../helpers.h"

namespace pbmpi::scenes {
namespace {

TEST(PartVelocities, are_those_of_one_part_of_every_copy) {
  const auto model =
      build(scene_with("human",
                       "velocity = [1, 0, 0]\ncopies = 2\nspacing = [2, 0, 0]\n"
                       "parts = { head = { velocity = [0, 0, 3], angular_velocity = [5, 0, 0] } }\n"));
  for (const std::string human : {"a.1", "a.2"}) {
    EXPECT_EQ(body(*model, human + ".head").velocity, Vec3(0, 0, 3));
    EXPECT_EQ(body(*model, human + ".head").angular_velocity, Vec3(5, 0, 0));
    EXPECT_EQ(body(*model, human + ".left_foot").velocity, Vec3(1, 0, 0));
  }
}

TEST(PartVelocities, of_a_part_that_is_not_there_are_refused) {
  const std::string message = error_of(scene_with("human", "parts = { haed = { velocity = [0, 0, 3] } }\n"));
  EXPECT_EQ(message.find(
                "test.toml:8:18: actor 'a', parts, haed: the actor has no part 'haed'; did you mean 'head'"),
            0u)
      << message;
}

}  // namespace
}  // namespace pbmpi::scenes
