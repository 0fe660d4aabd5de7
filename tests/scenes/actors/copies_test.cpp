#include "scenes/actors/copies.h"

#include <gtest/gtest.h>

#include "../helpers.h"

namespace pbmpi::scenes {
namespace {

/// The line after this text is the sixth.
const std::string ball =
    "title = \"t\"\n[[actor]]\nname = \"ball\"\ntype = \"sphere\"\nposition = [1, 2, 3]\n";
const std::string solid = "radius = 0.1\nmass = 1\n";

Vec3 position_of(const model::Model& model, const std::string& name) {
  return body(model, name).pose.position;
}

TEST(Copies, stand_in_a_row) {
  const auto model = build(ball + "copies = 3\nspacing = [0, 0, 1]\n" + solid);
  ASSERT_EQ(model->num_bodies(), 3);
  EXPECT_EQ(position_of(*model, "ball.1"), Vec3(1, 2, 3));
  EXPECT_EQ(position_of(*model, "ball.3"), Vec3(1, 2, 5));
}

TEST(Copies, stand_in_rows_of_rows_the_first_number_counting_fastest) {
  const auto model =
      build(ball + "copies = [3, 2, 4]\nspacing = [[1, 0, 0], [0.5, 2, 0], [0, 0, 3]]\n" + solid);
  ASSERT_EQ(model->num_bodies(), 24);
  EXPECT_EQ(position_of(*model, "ball.1"), Vec3(1, 2, 3));
  EXPECT_EQ(position_of(*model, "ball.2"), Vec3(2, 2, 3));
  EXPECT_EQ(position_of(*model, "ball.4"), Vec3(1.5, 4, 3));
  EXPECT_EQ(position_of(*model, "ball.7"), Vec3(1, 2, 6));
  EXPECT_EQ(position_of(*model, "ball.24"), Vec3(3.5, 4, 12));
}

TEST(Copies, stand_at_places) {
  const auto model = build(ball + "places = [[0, 0, 0], [5, 0, 0], [0, 7, 1]]\n" + solid);
  ASSERT_EQ(model->num_bodies(), 3);
  EXPECT_EQ(position_of(*model, "ball.2"), Vec3(6, 2, 3));
  EXPECT_EQ(position_of(*model, "ball.3"), Vec3(1, 9, 4));
}

TEST(Copies, have_numbers_even_where_there_is_one) {
  EXPECT_EQ(build(ball + "places = [[0, 0, 0]]\n" + solid)->bodies[0].name, "ball.1");
  EXPECT_EQ(build(ball + solid)->bodies[0].name, "ball");
}

TEST(Copies, that_cannot_be_are_refused_at_their_place) {
  struct Case {
    std::string lines, where, words;
  };
  for (const Case& one : {
           Case{"copies = [2, 3]\nspacing = [[1, 0, 0]]\n", "7:11",
                "an [x, y, z] for each number of 'copies', 2"},
           Case{"copies = [2, 3]\nspacing = [1, 0, 0]\n", "7:12", "three numbers [x, y, z]"},
           Case{"copies = [2, 0]\nspacing = [[1, 0, 0], [0, 1, 0]]\n", "6:14", "at least 1"},
           Case{"copies = [1000, 1001]\nspacing = [[1, 0, 0], [0, 1, 0]]\n", "6:10", "more than a million"},
           Case{"copies = []\nspacing = []\n", "6:10", "empty"},
           Case{"copies = 2\n", "2:1", "'spacing' is missing"},
           Case{"places = []\n", "6:10", "empty"},
           Case{"places = [[1, 2]]\n", "6:11", "three numbers [x, y, z]"},
           Case{"copies = 2\nspacing = [1, 0, 0]\nplaces = [[0, 0, 0]]\n", "8:10", "either 'copies'"},
       }) {
    const std::string message = error_of(ball + one.lines + solid);
    EXPECT_EQ(message.find("test.toml:" + one.where + ": actor 'ball': "), 0u) << message;
    EXPECT_NE(message.find(one.words), std::string::npos) << message;
  }
}

}  // namespace
}  // namespace pbmpi::scenes
