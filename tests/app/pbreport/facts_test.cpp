#include "app/pbreport/run/facts.h"

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

TEST(Facts, estimates_are_shown_where_there_are_any) {
  RunSummary summary;
  summary.measured_frames = 5;
  EXPECT_EQ(fact(summary, "Estimate").value, "");
  summary.estimate.emplace();
  summary.estimate->delivered_p50_s = 0.00125;
  summary.estimate->precise_over_delivered = 3.25;
  summary.estimate->position_defect.rms = 0.04;
  EXPECT_EQ(fact(summary, "Estimate").value, "1.25 ms");
  EXPECT_EQ(fact(summary, "Estimate").note, "delivered; precise 3.2 × later, rms off 40.0 mm");
}

}  // namespace
}  // namespace pbmpi::app
