#include <gtest/gtest.h>

#include <algorithm>

#include "helpers.h"

namespace pbmpi::scenes {
namespace {

TEST(Base, brings_all_that_the_file_does_not_change) {
  const auto base = parse_scene(find_scene("CrashSk"));
  const auto derived = parse("title = \"mine\"\nbase = \"CrashSk\"\n[run]\nreplicas = 4\n");
  EXPECT_EQ(derived->title(), "mine");
  EXPECT_EQ(derived->defaults().replicas, 4);
  EXPECT_EQ(derived->defaults().iterations, base->defaults().iterations);
  EXPECT_EQ(fingerprint(*derived->build(0, 1)), fingerprint(*base->build(0, 1)));
}

TEST(Base, an_actor_of_the_same_name_changes_only_the_keys_it_gives) {
  const auto base = parse_scene(find_scene("CrashSk"))->build(0, 1);
  const auto derived = build("title = \"t\"\nbase = \"CrashSk\"\n[[actor]]\nname = \"car\"\nspeed = 20\n");
  EXPECT_EQ(derived->num_bodies(), base->num_bodies());
  EXPECT_EQ(body(*derived, "car.chassis").velocity.x(), 20);
  EXPECT_EQ(body(*derived, "car.chassis").mass_kg, body(*base, "car.chassis").mass_kg);
}

TEST(Base, an_actor_of_a_new_name_is_added) {
  const auto base = parse_scene(find_scene("CrashSk"))->build(0, 1);
  const auto derived = build(
      "title = \"t\"\nbase = \"CrashSk\"\n[[actor]]\nname = \"ball\"\ntype = \"sphere\"\nradius = 0.1\nmass "
      "= 1\nposition = [0, 5, 0.1]\n");
  EXPECT_EQ(derived->num_bodies(), base->num_bodies() + 1);
}

TEST(Base, a_mistake_in_the_derived_file_is_told_at_its_own_place) {
  const std::string message =
      error_of("title = \"t\"\nbase = \"CrashSk\"\n[[actor]]\nname = \"car\"\nsteering = 3\n");
  EXPECT_EQ(message.find("test.toml:5:12: actor 'car'"), 0u) << message;
}

TEST(Base, an_unknown_key_in_the_derived_file_is_told_at_its_own_place) {
  const std::string message =
      error_of("title = \"t\"\nbase = \"CrashSk\"\n[[actor]]\nname = \"car\"\nsped = 3\n");
  EXPECT_EQ(message.find("test.toml:5:1: actor 'car': unknown key 'sped'; did you mean 'speed'"), 0u)
      << message;
}

TEST(Base, all_texts_on_which_a_scene_stands_are_named_the_nearest_first) {
  const SceneSource mine{"mine", "mine.toml", "title = \"t\"\nbase = \"100CrSk\"\n"};
  const std::vector<SceneSource> bases = bases_of(mine);
  ASSERT_EQ(bases.size(), 2u);
  EXPECT_EQ(bases[0].name, "100CrSk");
  EXPECT_EQ(bases[1].name, "CrashSk");
  EXPECT_EQ(bases[1].text, find_scene("CrashSk").text);
  EXPECT_TRUE(bases_of(bases[1]).empty());
}

TEST(Base, the_hundred_crashes_are_the_crash_with_other_poses_of_the_humans) {
  const auto hundred = parse_scene(find_scene("100CrSk"));
  const auto one = parse_scene(find_scene("CrashSk"))->build(0, 1);
  EXPECT_EQ(hundred->defaults().replicas, 100);
  const auto world = hundred->build(17, 1);
  ASSERT_EQ(world->num_bodies(), 37);  // a car of 5 bodies and two humans of 16
  ASSERT_EQ(one->num_bodies(), 37);
  EXPECT_EQ(body(*world, "car.chassis").pose.position, body(*one, "car.chassis").pose.position);
  EXPECT_NE(body(*world, "human1.head").pose.position, body(*one, "human1.head").pose.position);
}

TEST(Base, of_a_compound_gives_its_geoms_all_or_none) {
  const std::string head = "title = \"t\"\nbase = \"Bowling\"\n[[actor]]\nname = \"pin\"\n";
  EXPECT_EQ(body(*build(head + "mass = 1.6\n"), "pin.1").mass_kg, 1.6);
  const auto blocks =
      build(head + "geoms = [{ shape = \"box\", size = [0.1, 0.1, 0.3], position = [0, 0, 0.15] }]\n");
  EXPECT_EQ(std::ranges::count(blocks->geoms, model::Shape::box, &model::Geom::shape),
            5 + 10);  // lane and pit, pins
  EXPECT_EQ(std::ranges::count(blocks->geoms, model::Shape::cylinder, &model::Geom::shape), 0);
}

TEST(Base, of_a_hard_case_gives_its_bounds_key_by_key_and_its_expectations_all_or_none) {
  const auto base = parse_scene(find_scene("hard/free/bounce_half"))->hard_case();
  ASSERT_GT(base->expectations.size(), 1u);
  const std::string head = "title = \"t\"\nbase = \"hard/free/bounce_half\"\n";
  const auto bounded = parse(head + "[case.bounds]\ncreep = [1, 2]\n")->hard_case();
  EXPECT_EQ(bounded->bounds.size(), base->bounds.size() + 1);
  EXPECT_EQ(bounded->expectations.size(), base->expectations.size());
  EXPECT_EQ(bounded->source, base->source);
  const auto expecting =
      parse(head + "[[case.expect]]\nbody = \"ball\"\nquantity = \"z\"\nvalue = 0\nwithin = [1, 2]\n")
          ->hard_case();
  EXPECT_EQ(expecting->expectations.size(), 1u);
  EXPECT_EQ(expecting->bounds.size(), base->bounds.size());
}

}  // namespace
}  // namespace pbmpi::scenes
