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
}

TEST(NearestName, is_empty_where_nothing_is_near) {
  EXPECT_EQ(nearest_name("bananas", {"2-Cars", "CrashSk"}), "");
  EXPECT_EQ(nearest_name("x", {}), "");
}

}  // namespace
}  // namespace pbmpi::core
