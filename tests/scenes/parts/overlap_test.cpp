#include "scenes/parts/overlap.h"

#include <gtest/gtest.h>

#include "../helpers.h"

namespace pbmpi::scenes {
namespace {

const std::string box = "type = \"box\"\nsize = [1, 1, 1]\nmass = 1\n";

std::string two_boxes(const std::string& second) {
  return "[[actor]]\nname = \"a\"\n" + box + "position = [0, 0, 0.5]\n[[actor]]\nname = \"b\"\n" + box +
         second;
}

TEST(Overlap, of_two_actors_is_refused_at_the_second_ones_place) {
  const std::string message = error_after_ground(two_boxes("position = [0.9, 0, 0.5]\n"));
  EXPECT_EQ(message.find("test.toml:11:1: actor 'b': in world 0 it overlaps 'a' by 10 cm"), 0u) << message;
}

TEST(Overlap, is_allowed_as_deep_as_the_scene_says) {
  const std::string apart_by_tenth =
      "\n[[actor]]\nname = \"ground\"\ntype = \"ground\"\n" + two_boxes("position = [0.9, 0, 0.5]\n");
  EXPECT_EQ(error_of("title = \"t\"\noverlap = 0.11" + apart_by_tenth), "");
  EXPECT_EQ(error_of("title = \"t\"\noverlap = inf" + apart_by_tenth), "");
  EXPECT_NE(error_of("title = \"t\"\noverlap = 0.09" + apart_by_tenth).find("or allow it with 'overlap'"),
            std::string::npos);
  const std::string negative = error_of("title = \"t\"\noverlap = -1" + apart_by_tenth);
  EXPECT_EQ(negative.find("test.toml:2:11: scene: 'overlap' is -1; it must be at least 0"), 0u) << negative;
}

TEST(Overlap, of_a_body_and_the_ground_is_refused) {
  const std::string message = error_after_ground(two_boxes("position = [3, 0, 0.2]\n"));
  EXPECT_NE(message.find("overlaps 'ground' by 30 cm"), std::string::npos) << message;
}

TEST(Overlap, up_to_two_centimetres_is_a_contact) {
  EXPECT_EQ(error_after_ground(two_boxes("position = [0.985, 0, 0.49]\n")), "");
}

TEST(Overlap, is_measured_along_the_bodies_own_axes) {
  // Corner to face: half a diagonal, 0.707 m, plus half a side, 0.5 m; the distance is 1.2 or 1.21 m.
  const std::string turned = "rotation = { axis = [0, 0, 1], angle = 45 }\n";
  EXPECT_NE(error_after_ground(two_boxes("position = [1.17, 0, 0.5]\n" + turned)), "");
  EXPECT_EQ(error_after_ground(two_boxes("position = [1.21, 0, 0.5]\n" + turned)), "");
}

TEST(Overlap, of_two_actors_on_one_joint_is_allowed) {
  EXPECT_EQ(error_after_ground(two_boxes("position = [0.5, 0, 0.5]\n") +
                               "[[joint]]\nname = \"j\"\nkind = \"fixed\"\nbodies = [\"a\", \"b\"]\n"),
            "");
}

TEST(Overlap, of_copies_is_told_at_their_actor) {
  const std::string message = error_after_ground(
      "[[actor]]\nname = \"a\"\n" + box + "position = [0, 0, 0.5]\ncopies = 2\nspacing = [0.5, 0, 0]\n");
  EXPECT_EQ(message.find("test.toml:5:1: actor 'a.2'"), 0u) << message;
}

}  // namespace
}  // namespace pbmpi::scenes
