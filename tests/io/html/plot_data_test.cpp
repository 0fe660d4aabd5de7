#include "io/html/plot_data.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "page_sample.h"

namespace pbmpi::io::html {
namespace {

using Numbers = std::vector<double>;

TEST(PlotData, sums_and_bounds_the_worlds_of_each_frame) {
  const Band band = band_of({{3, 1, 2}, {1, 1, 4}}, 1);
  EXPECT_EQ(band.sum, (Numbers{6, 6}));
  EXPECT_EQ(band.min, (Numbers{1, 1}));
  EXPECT_EQ(band.mean, (Numbers{2, 2}));
  EXPECT_EQ(band.max, (Numbers{3, 4}));
}

TEST(PlotData, bins_frames_by_mean_sum_and_by_extreme_worlds) {
  const Band band = band_of({{1, 3}, {5, 7}, {2, 2}}, 2);
  EXPECT_EQ(band.sum, (Numbers{8, 4}));
  EXPECT_EQ(band.min, (Numbers{1, 2}));
  EXPECT_EQ(band.mean, (Numbers{4, 2}));
  EXPECT_EQ(band.max, (Numbers{7, 2}));
}

TEST(PlotData, an_empty_table_gives_no_points) { EXPECT_TRUE(band_of({}, 3).sum.empty()); }

TEST(PlotData, a_spike_survives_binning) {
  EXPECT_EQ(largest_of_bins({1, 9, 1, 1, 2}, 2), (Numbers{9, 1, 2}));
}

TEST(PlotData, averages_phases_over_the_measured_frames_only) {
  RunData run = sample_run({.num_worlds = 1, .num_records = 5, .num_ranks = 2});
  run.rank_times["collide"] = {{90, 90}, {90, 90}, {90, 90}, {0.001, 0.004}, {0.003, 0.004}};
  const auto plots = nlohmann::json::parse(plots_json(run, 0.1 / 30));
  ASSERT_EQ(plots["phases"][0]["name"], "collide");
  // A mean of two small binary fractions: off by rounding at most.
  EXPECT_NEAR(plots["phases"][0]["mean_ms"][0].get<double>(), 2, 1e-12);
  EXPECT_NEAR(plots["phases"][0]["mean_ms"][1].get<double>(), 4, 1e-12);
  EXPECT_EQ(plots["num_warmup"], 3);
}

TEST(PlotData, leaves_out_phases_in_which_no_rank_spent_time) {
  const auto plots = nlohmann::json::parse(plots_json(sample_run(), 0.1 / 30));
  for (const auto& phase : plots["phases"]) EXPECT_NE(phase["name"], "cross_space");
  EXPECT_EQ(plots["phases"].size(), 8u);  // of the sample's nine phases, cross_space is zero
}

TEST(PlotData, shows_what_a_simulation_should_keep_with_lengths_in_mm) {
  const auto plots =
      nlohmann::json::parse(plots_json(sample_run({.num_worlds = 2, .num_records = 4}), 0.1 / 30));
  EXPECT_EQ(plots["energy"]["mean"], (Numbers{1000, 990, 980, 970}));
  EXPECT_EQ(plots["linear_momentum"]["max"], (Numbers{50, 50, 50, 50}));  // (30, 40, 0)
  EXPECT_TRUE(plots["angular_momentum"].is_null());                       // the sample has none
  EXPECT_DOUBLE_EQ(plots["joint_gap_mm"]["max"][3].get<double>(), 0.4);
  EXPECT_DOUBLE_EQ(plots["max_penetration_mm"]["min"][0].get<double>(), 2);
}

TEST(PlotData, counts_frames_from_the_start_of_the_simulation) {
  RunData run = sample_run();
  EXPECT_EQ(nlohmann::json::parse(plots_json(run, 1))["first_frame"], 0);
  run.attributes["first_frame"] = "30";  // resumed from a checkpoint
  EXPECT_EQ(nlohmann::json::parse(plots_json(run, 1))["first_frame"], 30);
}

TEST(PlotData, draws_a_long_run_in_bins) {
  RunData run;
  run.num_ranks = 0;
  run.frame_wall_s.assign(max_plot_points * 3 + 1, 0.001);
  run.frame_measured.assign(run.frame_wall_s.size(), true);
  const auto plots = nlohmann::json::parse(plots_json(run, 0.1 / 30));
  EXPECT_EQ(plots["per_bin"], 4);
  EXPECT_LE(plots["wall_ms"].size(), max_plot_points);
  EXPECT_TRUE(plots["islands"].is_null());  // the run has no such observable
}

}  // namespace
}  // namespace pbmpi::io::html
