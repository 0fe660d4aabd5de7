#include "core/text.h"

#include <gtest/gtest.h>

namespace pbmpi::core {
namespace {

TEST(EditDistance, counts_insertions_deletions_and_replacements) {
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3);
  EXPECT_EQ(edit_distance("", "abc"), 3);
  EXPECT_EQ(edit_distance("abc", ""), 3);
  EXPECT_EQ(edit_distance("same", "same"), 0);
  EXPECT_EQ(edit_distance("flaw", "lawn"), edit_distance("lawn", "flaw"));
}

TEST(NearestName, finds_what_a_slip_meant) {
  const std::vector<std::string> names = {"2-Cars", "10-Cars", "CrashSk", "100CrSk"};
  EXPECT_EQ(nearest_name("CrashSc", names), "CrashSk");
  EXPECT_EQ(nearest_name("100crsk", names), "100CrSk");
  EXPECT_EQ(nearest_name("Crash", names), "CrashSk");
  EXPECT_EQ(nearest_name("mv", {"restitution", "mu"}), "mu");
}

TEST(NearestName, is_empty_where_nothing_is_near) {
  EXPECT_EQ(nearest_name("bananas", {"2-Cars", "CrashSk"}), "");
  EXPECT_EQ(nearest_name("x", {}), "");
  EXPECT_EQ(nearest_name("xyz", {"frames", "dt"}), "") << "another word, however short";
  EXPECT_EQ(nearest_name("bananas", {""}), "");
}

TEST(NearestNames, are_three_at_most_and_those_of_the_fewest_slips_come_first) {
  EXPECT_EQ(nearest_names("frams", {"replicas", "frames", "frame"}),
            (std::vector<std::string>{"frames", "frame"}));
  EXPECT_EQ(nearest_names("Crash", {"Fight", "CrashSk", "Crush", "CrashWa", "Crashes"}),
            (std::vector<std::string>{"CrashSk", "CrashWa", "Crashes"}));
}

TEST(Suggestion, lists_what_is_known_when_nothing_is_near) {
  EXPECT_EQ(suggestion("xyzxyz", {"mu", "restitution"}), "; known: 'mu', 'restitution'");
  EXPECT_EQ(suggestion("mv", {"mu", "restitution"}), "; did you mean 'mu'?");
  EXPECT_EQ(suggestion("mv", {}), "; there are none");
}

TEST(Text, a_value_that_is_not_there_is_empty) {
  const std::map<std::string, std::string> values = {{"scene", "CrashSk"}};
  EXPECT_EQ(value_in(values, "scene"), "CrashSk");
  EXPECT_EQ(value_in(values, "seed"), "");
}

}  // namespace
}  // namespace pbmpi::core
