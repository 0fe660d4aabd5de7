#include "app/pbreport/scaling/scaling_curves.h"

#include <gtest/gtest.h>

namespace pbmpi::app {
namespace {

/// The k-th run of a point, after the runs of the previous points in the round.
ScalingRun run_of(int ranks, int worlds, int round, double frame_s, const std::string& way = "worlds") {
  ScalingRun run;
  run.path =
      "w" + std::to_string(worlds) + "-r" + std::to_string(ranks) + way + std::to_string(round) + ".h5";
  run.created = "2026-01-01T00:00:0" + std::to_string(round) + "Z";
  run.scene = "Fight";
  run.problem = "scene = Fight\n";
  run.program = "0.1.0";
  run.decomposition = way;
  run.state_hash = "hash of " + std::to_string(worlds);
  run.ranks = run.most_ranks_of_a_host = ranks;
  run.worlds = worlds;
  run.processors = 8;
  run.frames = 10;
  run.frame_s = frame_s;
  run.useful_s = frame_s * ranks;
  run.pop = {1, 1, 1};
  return run;
}

std::vector<std::string> doubts_of(const std::vector<ScalingRun>& runs, const ScalingRules& rules = {2, 10}) {
  return curves_of(runs, rules).at(0).points.back().doubts;
}

TEST(ScalingCurves, pair_runs_by_their_starts) {
  // In a slow second round both points take three times as long, which no ratio shows.
  const std::vector<ScalingRun> runs = {run_of(2, 4, 2, 1.5), run_of(1, 4, 1, 0.8), run_of(2, 4, 1, 0.5),
                                        run_of(1, 4, 2, 2.4), run_of(1, 4, 3, 0.9), run_of(2, 4, 3, 0.5)};
  const auto curves = curves_of(runs, {});
  ASSERT_EQ(curves.size(), 1u);
  EXPECT_EQ(curves[0].kind, ScalingKind::strong);
  const ScalingPoint& two = curves[0].points.at(1);
  EXPECT_EQ(two.ranks, 2);
  EXPECT_DOUBLE_EQ(two.speed_up.median, 1.6);
  EXPECT_DOUBLE_EQ(two.speed_up.interval.low, 1.6);
  EXPECT_DOUBLE_EQ(two.speed_up.interval.high, 1.8);
  EXPECT_DOUBLE_EQ(two.efficiency.median, 0.8);
  EXPECT_DOUBLE_EQ(two.efficiency.interval.high, 0.9);
  EXPECT_EQ(curves[0].points[0].speed_up.median, 1);
}

TEST(ScalingCurves, grow_weakly_where_each_rank_has_as_many_worlds) {
  const std::vector<ScalingRun> runs = {run_of(1, 3, 1, 1.0), run_of(4, 12, 1, 1.25), run_of(2, 4, 1, 9)};
  const auto curves = curves_of(runs, {});
  ASSERT_EQ(curves.size(), 1u);
  EXPECT_EQ(curves[0].kind, ScalingKind::weak);
  const ScalingPoint& four = curves[0].points.at(1);
  EXPECT_DOUBLE_EQ(four.speed_up.median, 4 / 1.25);
  EXPECT_DOUBLE_EQ(four.efficiency.median, 0.8);
  EXPECT_DOUBLE_EQ(four.computation, 0.8) << "12 worlds cost 5 s of useful time, 3 cost 1";
  EXPECT_EQ(files_without_curve(runs, curves), std::vector<std::string>{runs[2].path});
}

TEST(ScalingCurves, start_from_the_fastest_way_on_the_fewest_ranks) {
  const std::vector<ScalingRun> runs = {run_of(1, 1, 1, 1.2, "spaces"), run_of(1, 1, 1, 1.0),
                                        run_of(2, 1, 1, 0.8, "spaces")};
  const auto curves = curves_of(runs, {});
  ASSERT_EQ(curves.size(), 1u) << "whole on one rank alone is no curve";
  EXPECT_EQ(curves[0].decomposition, "spaces");
  ASSERT_EQ(curves[0].points.size(), 3u);
  EXPECT_EQ(curves[0].points[curves[0].base].decomposition, "worlds");
  EXPECT_DOUBLE_EQ(curves[0].points[2].speed_up.median, 1.25);
  EXPECT_TRUE(files_without_curve(runs, curves).empty());
}

TEST(ScalingCurves, keep_other_work_apart) {
  std::vector<ScalingRun> runs = {run_of(1, 4, 1, 1), run_of(2, 4, 1, 0.5)};
  runs[1].problem = "scene = Fight\nseed = 2\n";
  EXPECT_TRUE(curves_of(runs, {}).empty());
  EXPECT_EQ(files_without_curve(runs, {}).size(), 2u);
}

TEST(ScalingCurves, doubt_nothing_of_runs_that_agree) {
  EXPECT_EQ(doubts_of({run_of(1, 4, 1, 1), run_of(2, 4, 1, 0.5), run_of(1, 4, 2, 1), run_of(2, 4, 2, 0.5)}),
            std::vector<std::string>{});
}

TEST(ScalingCurves, doubt_few_repeats_and_wide_intervals) {
  const std::vector<ScalingRun> runs = {run_of(1, 4, 1, 1), run_of(2, 4, 1, 0.5), run_of(1, 4, 2, 1),
                                        run_of(2, 4, 2, 0.4)};
  EXPECT_EQ(doubts_of(runs, {2, 0.3}), std::vector<std::string>{}) << "2 and 2.5: 22 % of 2.25";
  EXPECT_EQ(doubts_of(runs, {2, 0.2}), std::vector<std::string>{"interval of 22 %, 20 % at most"});
  EXPECT_EQ(doubts_of(runs, {5, 0.3}), std::vector<std::string>{"2 of 5 repeats"});
}

TEST(ScalingCurves, doubt_runs_that_are_not_alike) {
  const auto doubts_with = [](auto change, std::size_t which = 3) {
    std::vector<ScalingRun> runs = {run_of(1, 4, 1, 1), run_of(2, 4, 1, 0.5), run_of(1, 4, 2, 1),
                                    run_of(2, 4, 2, 0.5)};
    change(runs[which]);
    return doubts_of(runs);
  };
  using Doubts = std::vector<std::string>;
  EXPECT_EQ(doubts_with([](ScalingRun& run) { run.state_hash = "other"; }), Doubts{"2 different hashes"});
  EXPECT_EQ(doubts_with([](ScalingRun& run) { run.program = "0.2.0"; }),
            Doubts{"another build or processor than the base's"});
  EXPECT_EQ(doubts_with([](ScalingRun& run) { run.complete = false; }), Doubts{"a run that did not end"});
  EXPECT_EQ(doubts_with([](ScalingRun& run) { run.processors = 1; }), Doubts{"more ranks than processors"});
  constexpr std::size_t of_base = 2;
  EXPECT_EQ(doubts_with([](ScalingRun& run) { run.program = "0.2.0"; }, of_base),
            Doubts{"another build or processor than the base's"});
  EXPECT_EQ(doubts_with([](ScalingRun& run) { run.complete = false; }, of_base),
            Doubts{"a run that did not end"});
  EXPECT_EQ(doubts_with([](ScalingRun& run) { run.processors = 0; }), Doubts{})
      << "of an older file: not known";
}

TEST(PopEfficiencies, multiply_to_the_parallel_efficiency) {
  // Two ranks compute for 6 and 8 s of 10; the second waits and the first exchanges for 1 s longer.
  const PopEfficiencies found = efficiencies_of({6, 8}, {2, 1}, 10);
  EXPECT_DOUBLE_EQ(found.load_balance, 7. / 8);
  EXPECT_DOUBLE_EQ(found.transfer, 9. / 10);
  EXPECT_DOUBLE_EQ(found.serialisation, 8. / 9);
  EXPECT_DOUBLE_EQ(found.load_balance * found.transfer * found.serialisation, 14. / 2 / 10);
}

TEST(PopEfficiencies, are_zero_where_nothing_was_done) {
  EXPECT_EQ(efficiencies_of({0, 0}, {0, 0}, 1).transfer, 0);
}

}  // namespace
}  // namespace pbmpi::app
