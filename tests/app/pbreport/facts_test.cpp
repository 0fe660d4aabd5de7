#include "app/pbreport/facts.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace pbmpi::app {
namespace {

io::html::Fact fact(const RunSummary& summary, const std::string& label) {
  const auto facts = facts_of(summary);
  const auto found =
      std::find_if(facts.begin(), facts.end(), [&](const auto& f) { return f.label == label; });
  return found == facts.end() ? io::html::Fact{} : *found;
}

TEST(Facts, group_thousands_and_count_in_plain_words) {
  RunSummary summary;
  summary.bodies = 1234567;
  summary.worlds = 1;
  EXPECT_EQ(fact(summary, "Size").value, "1,234,567 bodies");
  EXPECT_EQ(fact(summary, "Size").note, "in 1 world");
}

TEST(Facts, a_run_without_a_measured_frame_claims_no_speed) {
  RunSummary summary;
  EXPECT_EQ(fact(summary, "Frame rate").value, "not measured");
  EXPECT_EQ(fact(summary, "Efficiency").value, "");
}

TEST(Facts, times_are_in_milliseconds) {
  RunSummary summary;
  summary.measured_frames = 5;
  summary.frame_p50_s = 0.0021;
  summary.budget_s = 0.1 / 30;
  EXPECT_EQ(fact(summary, "Frame time").value, "2.10 ms");
  EXPECT_EQ(fact(summary, "Within budget").note, "of frames in 3.33 ms");
}

}  // namespace
}  // namespace pbmpi::app
