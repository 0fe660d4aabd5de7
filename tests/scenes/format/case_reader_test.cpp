#include "scenes/format/case_reader.h"

#include <gtest/gtest.h>

#include <cmath>

#include "../helpers.h"

namespace pbmpi::scenes {
namespace {

// The case begins at line 8, its own keys at line 9.
const std::string box_and_case = R"(title = "t"
[[actor]]
name = "box"
type = "box"
size = [1, 1, 1]
mass = 1

[case]
group = "rest"
row = 7
source = "a paper"
oracle = "it stands"
)";

stability::HardCase case_of(const std::string& more) { return *parse(box_and_case + more)->hard_case(); }

TEST(CaseReader, reads_what_is_measured_and_what_counts_as_right) {
  const stability::HardCase found = case_of(
      "seconds = 4\nsettle = 1\nwatch = [\"bo\"]\nregion = { low = [-1, -inf, 0] }\n"
      "[case.bounds]\ndrift = [0.01, 0.2]\n"
      "[[case.expect]]\nbody = \"box\"\nquantity = \"vz\"\nat = 2\nvalue = -9.81\nwithin = [1e-3, 1]\n");
  EXPECT_EQ(found.group, "rest");
  EXPECT_EQ(found.row, 7);
  EXPECT_EQ(found.seconds, 4);
  EXPECT_EQ(found.settle_s, 1);
  EXPECT_EQ(found.watch, std::vector<std::string>{"bo"});
  EXPECT_EQ(found.region.low.x(), -1);
  EXPECT_TRUE(std::isinf(found.region.low.y()) && std::isinf(found.region.high.z()));
  ASSERT_EQ(found.bounds.size(), 1u);
  EXPECT_EQ(found.bounds[0].metric, stability::Metric::drift);
  EXPECT_EQ(found.bounds[0].limits.right, 0.01);
  EXPECT_EQ(found.bounds[0].limits.broken, 0.2);
  ASSERT_EQ(found.expectations.size(), 1u);
  EXPECT_EQ(found.expectations[0].quantity, stability::Quantity::vz);
  EXPECT_EQ(found.expectations[0].at_s, 2);
  EXPECT_EQ(found.expectations[0].value, -9.81);
  EXPECT_EQ(found.expectations[0].off_by.broken, 1);
}

TEST(CaseReader, expects_at_the_end_unless_told_otherwise) {
  const stability::HardCase found =
      case_of("seconds = 4\n[[case.expect]]\nbody = \"box\"\nquantity = \"z\"\nvalue = 0\nwithin = [1, 2]\n");
  EXPECT_EQ(found.expectations[0].at_s, 4);
}

TEST(CaseReader, a_scene_without_a_case_has_none) {
  EXPECT_FALSE(parse(scene_with("box", "size = [1, 1, 1]\nmass = 1\nposition = [0, 0, 1]\n"))->hard_case());
}

TEST(CaseReader, names_the_nearest_metric_and_quantity) {
  const std::string metric = error_of(box_and_case + "[case.bounds]\ndrit = [0, 1]\n");
  EXPECT_EQ(metric.find("test.toml:14:1: case, bounds: unknown key 'drit'; did you mean 'drift'"), 0u)
      << metric;
  const std::string quantity = error_of(
      box_and_case + "[[case.expect]]\nbody = \"box\"\nquantity = \"sped\"\nvalue = 0\nwithin = [0, 1]\n");
  EXPECT_EQ(quantity.find("test.toml:15:12: case, expect: unknown quantity 'sped'; did you mean 'speed'"), 0u)
      << quantity;
}

TEST(CaseReader, refuses_bounds_the_wrong_way_round) {
  const std::string message = error_of(box_and_case + "[case.bounds]\ndrift = [1, 0]\n");
  EXPECT_EQ(message.find("test.toml:14:9: case, bounds: what is right lies beyond what is broken"), 0u)
      << message;
}

TEST(CaseReader, refuses_bodies_that_are_not_there) {
  const std::string expected = error_of(
      box_and_case + "[[case.expect]]\nbody = \"bix\"\nquantity = \"z\"\nvalue = 0\nwithin = [0, 1]\n");
  EXPECT_EQ(expected.find("test.toml:14:8: case, expect: unknown body 'bix'; did you mean 'box'"), 0u)
      << expected;
  const std::string watched = error_of(box_and_case + "watch = [\"ball\"]\n");
  EXPECT_EQ(watched.find("test.toml:13:9: case: no body's name begins with 'ball'"), 0u) << watched;
}

TEST(CaseReader, refuses_an_expectation_after_the_end) {
  const std::string message = error_of(
      box_and_case +
      "seconds = 4\n[[case.expect]]\nbody = \"box\"\nquantity = \"z\"\nat = 5\nvalue = 0\nwithin = [0, 1]\n");
  EXPECT_EQ(message.find("test.toml:17:6: case, expect: the case has ended by then"), 0u) << message;
}

TEST(CaseReader, refuses_a_region_without_room) {
  const std::string message = error_of(box_and_case + "region = { low = [0, 0, 0], high = [1, 1, -1] }\n");
  EXPECT_EQ(message.find("test.toml:13:10: case: nothing lies in the region"), 0u) << message;
}

}  // namespace
}  // namespace pbmpi::scenes
