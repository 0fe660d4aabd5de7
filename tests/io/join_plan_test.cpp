#include "io/join/join_plan.h"

#include <gtest/gtest.h>

#include <array>

#include "core/error.h"

namespace pbmpi::io {
namespace {

std::string refusal(const std::vector<PartFrames>& parts, std::int64_t record_every = 1) {
  try {
    const JoinPlan plan(parts, record_every);
  } catch (const core::InputError& error) {
    return error.what();
  }
  return "";
}

TEST(JoinPlan, takes_each_frame_from_the_last_part_that_has_it) {
  const JoinPlan plan({{"a", 0, 10}, {"b", 6, 2}, {"c", 9, 11}}, 1);
  ASSERT_EQ(plan.stretches().size(), 4u);
  const std::vector<std::array<std::int64_t, 3>> expected = {{0, 0, 6}, {1, 6, 2}, {0, 8, 1}, {2, 9, 11}};
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_EQ(static_cast<std::int64_t>(plan.stretches()[i].part), expected[i][0]);
    EXPECT_EQ(plan.stretches()[i].first, expected[i][1]);
    EXPECT_EQ(plan.stretches()[i].count, expected[i][2]);
  }
  EXPECT_EQ(plan.num_frames(), 20);
  EXPECT_EQ(plan.part_of(8), 0u);
  EXPECT_EQ(plan.part_of(25), 2u) << "what happened behind the last frame is the last part's";
}

TEST(JoinPlan, compares_the_frames_that_come_from_another_part) {
  const JoinPlan plan({{"a", 0, 10}, {"b", 6, 2}, {"c", 9, 11}}, 1);
  const std::vector<Stretch> overlaps = plan.overlaps_of(0);
  ASSERT_EQ(overlaps.size(), 2u);
  EXPECT_EQ(overlaps[0].part, 1u);
  EXPECT_EQ(overlaps[0].first, 6);
  EXPECT_EQ(overlaps[0].count, 2);
  EXPECT_EQ(overlaps[1].part, 2u);
  EXPECT_EQ(overlaps[1].first, 9);
  EXPECT_EQ(overlaps[1].count, 1);
  EXPECT_TRUE(plan.overlaps_of(2).empty());
}

TEST(JoinPlan, names_the_frames_that_are_missing_and_the_files_beside_them) {
  EXPECT_EQ(refusal({{"a", 0, 5}, {"b", 7, 3}}),
            "frames 5 to 6 are missing: a ends before, b begins behind; name the file of the run between "
            "them, too");
  EXPECT_EQ(refusal({{"a", 0, 5}, {"b", 6, 3}}).rfind("frame 5 is missing: ", 0), 0u);
  EXPECT_NE(refusal({{"a", 0, 5}, {"b", 5, 0}}).find("b: it has no frame"), std::string::npos);
}

TEST(JoinPlan, counts_recorded_rows_from_the_start_of_each_file) {
  const JoinPlan plan({{"a", 3, 8}, {"b", 9, 6}}, 3);
  const JoinPlan::Rows all = plan.recorded_rows(9, 6, plan.first()), in_b = plan.recorded_rows(9, 6, 9);
  EXPECT_EQ(all.first, 2);
  EXPECT_EQ(all.count, 2);
  EXPECT_EQ(in_b.first, 0);
  EXPECT_EQ(in_b.count, 2);
  EXPECT_EQ(plan.recorded_rows(3, 6, 3).count, 2);
}

TEST(JoinPlan, refuses_an_interval_of_recording_that_begins_anew_in_between) {
  EXPECT_NE(refusal({{"a", 0, 8}, {"b", 7, 6}}, 3).find("b: one frame of 3 is recorded"), std::string::npos);
  EXPECT_EQ(refusal({{"a", 0, 8}, {"b", 6, 6}}, 3), "");
  EXPECT_EQ(refusal({{"a", 0, 8}, {"b", 5, 3}, {"c", 6, 6}}, 3).rfind("b: one frame", 0), 0u)
      << "frame 5 comes from it";
}

}  // namespace
}  // namespace pbmpi::io
