#include "scenes/links/contact_groups.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "../mjcf/models.h"
#include "model/touch_rule.h"

namespace pbmpi::scenes {
namespace {

/// A floor, and spheres a, b, c, d that are all free, unless they specify more.
std::string four(const std::string& floor = "", const std::string& geom = "", const std::string& contact = "",
                 const std::string& of_a = "") {
  std::string xml = "<mujoco><worldbody><geom type='plane' size='1 1 1' " + floor + "/>";
  for (const char* name : {"a", "b", "c", "d"})
    xml += "<body name='" + std::string(name) + "'><freejoint/><geom size='1' " +
           (*name == 'a' && !of_a.empty() ? of_a : geom) + "/></body>";
  return xml + "</worldbody><contact>" + contact + "</contact></mujoco>";
}

/// May the geoms of these two touch? 0: the floor, 1 to 4: the spheres.
bool touch(const std::string& xml, int first, int second) {
  const auto model = model_of(xml);
  return model::TouchRule(*model).may_touch(first, second);
}

TEST(ContactGroups, let_all_touch_by_default) {
  for (int i = 0; i < 5; ++i) {
    for (int j = i + 1; j < 5; ++j) EXPECT_TRUE(touch(four(), i, j)) << i << ' ' << j;
  }
  EXPECT_TRUE(notes_of(four()).empty());
}

TEST(ContactGroups, part_excluded_bodies_alone) {
  const std::string xml = four("", "", "<exclude body1='a' body2='b'/>");
  EXPECT_FALSE(touch(xml, 1, 2));
  EXPECT_TRUE(touch(xml, 1, 3));
  EXPECT_TRUE(touch(xml, 3, 4));
  EXPECT_TRUE(touch(xml, 0, 1));
  EXPECT_TRUE(notes_of(xml).empty());
}

TEST(ContactGroups, say_whom_they_part_besides) {
  const std::string xml = four("", "", "<exclude body1='a' body2='b'/><exclude body1='a' body2='c'/>");
  EXPECT_FALSE(touch(xml, 2, 3)) << "a Model cannot part a from b and c, and let these touch";
  EXPECT_TRUE(says(notes_of(xml), "'b' and 'c' do not touch either"));
  EXPECT_TRUE(touch(xml, 3, 4));
}

TEST(ContactGroups, follow_types_and_affinities) {
  // As in robots whose parts touch only the floor.
  const std::string xml = four("conaffinity='1'", "contype='1' conaffinity='0'");
  EXPECT_TRUE(touch(xml, 0, 1));
  EXPECT_FALSE(touch(xml, 1, 2));
  EXPECT_TRUE(notes_of(xml).empty());
  const std::string other = four("", "", "", "contype='2' conaffinity='2'");
  EXPECT_FALSE(touch(other, 0, 1));
  EXPECT_FALSE(touch(other, 1, 2));
}

TEST(ContactGroups, leave_out_geoms_that_meet_none) {
  EXPECT_EQ(model_of(four("", "contype='0' conaffinity='0'"))->geoms.size(), 1u);
  EXPECT_TRUE(model_of("<mujoco><option><flag contact='disable'/></option><worldbody>" +
                       boxed("<freejoint/>") + "</worldbody></mujoco>")
                  ->geoms.empty());
}

TEST(ContactGroups, keep_parent_and_child_apart_but_not_the_world) {
  const std::string geom = "<geom size='1'/>";
  const std::string xml = mujoco(geom + "<body name='a'><joint/>" + geom + "<body name='b'><joint/>" + geom +
                                 "<body name='c'><joint/><joint axis='1 0 0'/><joint axis='0 1 0'/>" + geom +
                                 "</body></body></body>");
  EXPECT_TRUE(touch(xml, 0, 1));
  EXPECT_FALSE(touch(xml, 1, 2));
  EXPECT_FALSE(touch(xml, 2, 3)) << "a body stands between";
  EXPECT_TRUE(touch(xml, 1, 3));
}

// MuJoCo excludes the geoms of the two bodies, not of all that stands fast with them.
TEST(ContactGroups, part_a_body_from_a_fixed_one_and_not_from_the_floor) {
  const std::string geom = "<geom size='1'/>";
  const std::string xml = "<mujoco><worldbody><geom type='plane' size='1 1 1'/><body name='base'>" + geom +
                          "<body name='a'><joint/>" + geom +
                          "</body></body></worldbody>"
                          "<contact><exclude body1='base' body2='a'/></contact></mujoco>";
  EXPECT_TRUE(touch(xml, 0, 2)) << "the floor";
  EXPECT_FALSE(touch(xml, 1, 2)) << "the base";
}

/// A sphere that stands free, on a place of its own, with the i-th mask of each list.
std::string loose_sphere(int i, int num_types, int num_affinities) {
  return "<body name='b" + std::to_string(i) + "' pos='" + std::to_string(3 * i) +
         " 0 0'><freejoint/><geom size='1' contype='" + std::to_string(1 + i % num_types) +
         "' conaffinity='" + std::to_string(1 + i % num_affinities) + "'/></body>";
}

TEST(ContactGroups, part_whoever_is_linked_by_pairs_that_must_not_touch) {
  constexpr int count = 12;
  for (const auto& [types, affinities] : {std::pair(2, 5), {4, 3}, {7, 2}, {1, 8}}) {
    std::string bodies;
    for (int i = 0; i < count; ++i) bodies += loose_sphere(i, types, affinities);
    const auto model = model_of(mujoco(bodies));
    bool linked[count][count];
    for (int i = 0; i < count; ++i) {
      for (int j = 0; j < count; ++j) {
        linked[i][j] =
            ((1 + i % types) & (1 + j % affinities)) == 0 && ((1 + j % types) & (1 + i % affinities)) == 0;
      }
    }
    for (int k = 0; k < count; ++k) {
      for (int i = 0; i < count; ++i) {
        for (int j = 0; j < count; ++j) linked[i][j] = linked[i][j] || (linked[i][k] && linked[k][j]);
      }
    }
    const model::TouchRule rule(*model);
    for (int i = 0; i < count; ++i) {
      for (int j = i + 1; j < count; ++j)
        EXPECT_EQ(rule.may_touch(i, j), !linked[i][j]) << types << ": " << i << ' ' << j;
    }
  }
}

// Pairs of bodies, one by one, would take gigabytes.
TEST(ContactGroups, of_many_bodies_are_found_without_their_pairs) {
  constexpr int count = 30'000;
  std::string bodies;
  for (int i = 0; i < count; ++i) bodies += loose_sphere(i, 3, 5);
  const auto model = model_of(mujoco(bodies));
  EXPECT_EQ(model->num_bodies(), count);
}

}  // namespace
}  // namespace pbmpi::scenes
