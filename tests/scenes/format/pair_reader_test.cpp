#include "scenes/format/pair_reader.h"

#include <gtest/gtest.h>

#include "../helpers.h"
#include "model/contact.h"

namespace pbmpi::scenes {
namespace {

// The pair begins at line 15.
const std::string ground_and_boxes = R"(title = "t"
[[actor]]
name = "ground"
type = "ground"
[[actor]]
name = "box"
type = "box"
size = [1, 1, 1]
mass = 1
position = [0, 0, 0.5]
copies = 3
spacing = [2, 0, 0]
material = { mu = 0.3 }

[[pair]]
)";

/// The material of geom 0, the ground, with box `number`.
model::Material on_ground(const model::Model& model, int number) {
  return model::pair_material(model, {0, number}, model.geoms[0].material, model.geoms[number].material);
}

TEST(PairReader, gives_a_pair_of_actors_a_material_of_its_own) {
  const auto model =
      build(ground_and_boxes + "actors = [\"box.2\", \"ground\"]\nmu = 0.9\nrestitution = 0.5\n");
  EXPECT_EQ(on_ground(*model, 2).mu, 0.9);
  EXPECT_EQ(on_ground(*model, 2).restitution, 0.5);
  EXPECT_NE(on_ground(*model, 1).mu, 0.9);
  EXPECT_NE(on_ground(*model, 3).mu, 0.9);
}

TEST(PairReader, a_name_without_a_number_means_all_copies) {
  const auto model = build(ground_and_boxes + "actors = [\"ground\", \"box\"]\nmu = 0\n");
  EXPECT_EQ(model->pair_materials.size(), 3u);
  for (const int number : {1, 2, 3}) EXPECT_EQ(on_ground(*model, number).mu, 0);
  const auto among_each_other = build(ground_and_boxes + "actors = [\"box\", \"box\"]\nmu = 0\n");
  EXPECT_EQ(among_each_other->pair_materials.size(), 6u) << "a copy with itself, too";
}

TEST(PairReader, a_later_pair_goes_before_an_earlier_one) {
  const auto model = build(ground_and_boxes +
                           "actors = [\"ground\", \"box\"]\nmu = 0\n"
                           "[[pair]]\nactors = [\"box.3\", \"ground\"]\nmu = 1\n");
  EXPECT_EQ(on_ground(*model, 1).mu, 0);
  EXPECT_EQ(on_ground(*model, 3).mu, 1);
}

TEST(PairReader, is_dropped_with_the_effects_that_it_is_about) {
  const auto model =
      build(ground_and_boxes +
            "actors = [\"ground\", \"box\"]\nmu = 1\nrestitution = 1\n[effects]\nfriction = false\n"
            "restitution = false\n");
  EXPECT_EQ(on_ground(*model, 1).mu, 0);
  EXPECT_EQ(on_ground(*model, 1).restitution, 0);
}

TEST(PairReader, tells_of_actors_that_are_not_there) {
  const std::string message = error_of(ground_and_boxes + "actors = [\"ground\", \"bix\"]\nmu = 1\n");
  EXPECT_EQ(message.find("test.toml:16:10: pair: unknown actor 'bix'"), 0u) << message;
}

TEST(PairReader, refuses_what_is_no_pair_and_a_bounce_that_gains) {
  const std::string one = error_of(ground_and_boxes + "actors = [\"ground\"]\nmu = 1\n");
  EXPECT_EQ(one.find("test.toml:16:10: pair: 'actors' must name two actors"), 0u) << one;
  const std::string gain =
      error_of(ground_and_boxes + "actors = [\"ground\", \"box\"]\nmu = 1\nrestitution = 1.5\n");
  EXPECT_EQ(gain.find("test.toml:18:15: pair: 'restitution' must lie in [0, 1]"), 0u) << gain;
}

}  // namespace
}  // namespace pbmpi::scenes
