#include "scenes/format/interest.h"

#include <gtest/gtest.h>

#include "../helpers.h"
#include "effects/effects.h"

namespace pbmpi::scenes {
namespace {

const std::string balls =
    "[[actor]]\nname = \"ball\"\ntype = \"sphere\"\nradius = 0.2\nmass = 1\nposition = [0, 0, 1]\n"
    "copies = 3\nspacing = [2, 0, 0]\n[[actor]]\nname = \"car\"\ntype = \"car\"\nposition = [0, 9, 0]\n";

std::string with_interest(const std::string& keys) {
  return "title = \"t\"\n[[actor]]\nname = \"ground\"\ntype = \"ground\"\n[interest]\n" + keys + balls;
}

TEST(Interest, lies_round_a_place) {
  const auto model = build(with_interest("center = [1, 2, 3]\nradius = 4.5\noutside_iterations = 7\n"));
  ASSERT_TRUE(model->interest.has_value());
  EXPECT_EQ(model->interest->center, Vec3(1, 2, 3));
  EXPECT_EQ(model->interest->follows, model::no_body);
  EXPECT_EQ(model->interest->radius_m, 4.5);
  EXPECT_EQ(model->interest->outside_iterations, 7);
}

TEST(Interest, follows_the_first_body_of_an_actor) {
  const auto followed = [](const std::string& actor) {
    const auto model = build(with_interest("follows = \"" + actor + "\"\nradius = 1\n"));
    EXPECT_EQ(model->interest->outside_iterations, 4) << "the default";
    return model->bodies[static_cast<std::size_t>(model->interest->follows)].name;
  };
  EXPECT_EQ(followed("ball.2"), "ball.2");
  EXPECT_EQ(followed("car"), "car.chassis");
}

TEST(Interest, is_none_without_the_table_and_where_the_effect_is_left_out) {
  EXPECT_FALSE(build(scene_with("car"))->interest.has_value());
  const std::string text = with_interest("follows = \"car\"\nradius = 1\n");
  EXPECT_FALSE(build(text + "[effects]\nfield_of_interest = false\n")->interest.has_value());
  EXPECT_TRUE(effects::StepPlan(*build(text)).has(effects::EffectId::field_of_interest));
}

TEST(Interest, tells_the_place_of_each_mistake) {
  struct Case {
    const char *keys, *place, *words;
  };
  for (const Case& one : {
           Case{"radius = 1\n", "test.toml:5:", "either 'center', a point, or 'follows'"},
           Case{"center = [0, 0, 0]\nfollows = \"car\"\nradius = 1\n", "test.toml:7:", "either 'center'"},
           Case{"follows = \"ball\"\nradius = 1\n", "test.toml:6:", "unknown actor 'ball'"},
           Case{"follows = \"ground\"\nradius = 1\n", "test.toml:6:", "no body to follow"},
           Case{"follows = \"car\"\n", "test.toml:5:", "radius"},
           Case{"follows = \"car\"\nradius = 0\n", "test.toml:7:", "radius"},
           Case{"follows = \"car\"\nradius = 1\noutside_iterations = 0\n", "test.toml:8:", "at least 1"},
           Case{"follows = \"car\"\nradius = 1\noutside = 2\n", "test.toml:8:", "outside_iterations"},
       }) {
    const std::string message = error_of(with_interest(one.keys));
    EXPECT_NE(message.find(one.place), std::string::npos) << message;
    EXPECT_NE(message.find(one.words), std::string::npos) << message;
  }
}

}  // namespace
}  // namespace pbmpi::scenes
