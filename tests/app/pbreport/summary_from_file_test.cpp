#include "app/pbreport/summary_from_file.h"

#include <gtest/gtest.h>

#include "core/error.h"

namespace pbmpi::app {
namespace {

/// Two worlds on two ranks; one warm-up frame, whose numbers differ strongly from the others', and two
/// measured frames.
io::RunData small_run() {
  io::RunData run;
  run.attributes = {{"pbmpi_version", "1.2.3"}, {"scene", "Test"}, {"state_hash", "00000000000000ff"}};
  run.parameters = {{"stepper", "quick"},
                    {"precision", "double"},
                    {"iterations", "20"},
                    {"substeps", "1"},
                    {"steps_per_frame", "3"},
                    {"dt", "0.01"},
                    {"seed", "18446744073709551615"}};
  run.complete = true;
  run.frames_committed = 3;
  run.num_worlds = 2;
  run.num_ranks = 2;
  run.num_bodies = 4;
  run.hosts = {"a", "a"};
  run.frame_wall_s = {1, 0.002, 0.006};
  run.frame_measured = {false, true, true};
  run.observables["islands"] = {{9, 9}, {3, 2}, {1, 2}};
  run.observables["contacts"] = {{90, 90}, {4, 6}, {10, 10}};
  run.observables["rows"] = {{900, 900}, {40, 60}, {100, 100}};
  run.observables["energy"] = {{900, 900}, {5, 6}, {3, 4}};
  run.observables["nonfinite"] = {{0, 0}, {0, 0}, {1, 2}};
  run.observables["joint_gap"] = {{9, 9}, {0.001, 0.002}, {0.0015, 0}};
  run.observables["max_penetration"] = {{9, 9}, {0.003, 0.001}, {0, 0.004}};
  run.rank_times["collide"] = {{5, 5}, {0.001, 0.0005}, {0.003, 0.0015}};
  run.rank_times["wait"] = {{5, 5}, {0, 0.0005}, {0.001, 0.0005}};
  run.rank_times["processor"] = {{7, 7}, {0.002, 0.001}, {0.002, 0.002}};
  run.rank_times["useful"] = {{5, 5}, {0.001, 0.0005}, {0.003, 0.0015}};
  run.events = {{1, "rebalance", "3 worlds moved"}, {2, "signal", "TERM"}};
  run.num_events = {{"rebalance", 2}, {"signal", 1}, {"joint_broken", 700}};  // more than there are rows
  run.worlds_moved = 5;
  return run;
}

// Sums of a few decimal fractions differ only in the last bits.
constexpr double rounding = 1e-12;

TEST(SummaryFromFile, takes_only_the_measured_frames) {
  const RunSummary summary = summary_from_file(small_run(), "x.h5");
  EXPECT_EQ(summary.warmup_frames, 1);
  EXPECT_EQ(summary.measured_frames, 2);
  EXPECT_NEAR(summary.harmonic_mean_hz, 2 / 0.008, 1e-9);
  EXPECT_DOUBLE_EQ(summary.satisfied_fraction, 0.5);  // 2 ms meets the budget of 3.33 ms, 6 ms does not
  EXPECT_DOUBLE_EQ(summary.frame_max_s, 0.006);
  EXPECT_EQ(summary.islands.max, 5);
  EXPECT_EQ(summary.islands.min, 3);
  EXPECT_DOUBLE_EQ(summary.islands.mean, 4);
  EXPECT_DOUBLE_EQ(summary.contacts_mean, 15);
  EXPECT_DOUBLE_EQ(summary.contacts_max, 20);
  EXPECT_DOUBLE_EQ(summary.rows_max, 200);
}

TEST(SummaryFromFile, names_the_ranks_of_least_and_most_time) {
  const RunSummary summary = summary_from_file(small_run(), "x.h5");
  ASSERT_EQ(summary.phases.size(), 2u);
  EXPECT_EQ(summary.phases[0].name, "collide");
  EXPECT_NEAR(summary.phases[0].min_s, 0.002, rounding);
  EXPECT_EQ(summary.phases[0].min_rank, 1);
  EXPECT_NEAR(summary.phases[0].avg_s, 0.003, rounding);
  EXPECT_NEAR(summary.phases[0].max_s, 0.004, rounding);
  EXPECT_EQ(summary.phases[0].max_rank, 0);
}

TEST(SummaryFromFile, knows_the_processor_time_of_the_busiest_rank_unless_the_file_is_older) {
  io::RunData run = small_run();
  const RunSummary summary = summary_from_file(run, "x.h5");
  EXPECT_NEAR(summary.processor.busiest_s, 0.002, rounding);
  EXPECT_NEAR(summary.processor.mean_s, 0.00175, rounding);
  EXPECT_EQ(summary.processor.busiest_rank, 0);
  run.rank_times.erase("processor");
  EXPECT_EQ(summary_from_file(run, "x.h5").processor.busiest_s, 0);
}

TEST(SummaryFromFile, efficiency_is_balance_times_communication) {
  const RunSummary summary = summary_from_file(small_run(), "x.h5");
  EXPECT_NEAR(summary.load_balance, 0.75, rounding);             // mean 3 ms of at most 4 ms
  EXPECT_NEAR(summary.communication_efficiency, 0.5, rounding);  // 4 ms of 8 ms
  EXPECT_NEAR(summary.parallel_efficiency, 0.375, rounding);
}

TEST(SummaryFromFile, counts_steps_of_worlds_and_bodies) {
  const RunSummary summary = summary_from_file(small_run(), "x.h5");
  EXPECT_NEAR(summary.world_steps_per_s, 2 * 3 * 2 / 0.008, 1e-9);
  EXPECT_NEAR(summary.body_steps_per_s, 4 * 3 * 2 / 0.008, 1e-9);
}

TEST(SummaryFromFile, invariants_are_the_worst_measured_and_the_last_state) {
  const RunSummary summary = summary_from_file(small_run(), "x.h5");
  EXPECT_EQ(summary.nonfinite_bodies, 3);
  EXPECT_DOUBLE_EQ(summary.max_joint_gap_m, 0.002);
  EXPECT_DOUBLE_EQ(summary.max_penetration_m, 0.004);
  EXPECT_DOUBLE_EQ(summary.energy_j, 7);
}

TEST(SummaryFromFile, carries_settings_and_hosts_once) {
  const RunSummary summary = summary_from_file(small_run(), "x.h5");
  EXPECT_EQ(summary.seed, 18446744073709551615ull);
  EXPECT_EQ(summary.dt_s, 0.01);
  EXPECT_EQ(summary.hosts, std::vector<std::string>{"a"});
  EXPECT_EQ(summary.output, "x.h5");
  EXPECT_EQ(summary.state_hash, "00000000000000ff");
}

TEST(SummaryFromFile, counts_events_for_which_the_file_had_no_row) {
  const RunSummary summary = summary_from_file(small_run(), "x.h5");
  EXPECT_EQ(summary.rebalances, 2);
  EXPECT_EQ(summary.worlds_moved, 5);
  EXPECT_EQ(summary.joints_broken, 700);
}

TEST(SummaryFromFile, a_rank_without_work_is_idle) {
  io::RunData run = small_run();
  EXPECT_TRUE(summary_from_file(run, "x.h5").idle_ranks.empty());
  run.rank_times["useful"].back() = {0.004, 0};
  EXPECT_EQ(summary_from_file(run, "x.h5").idle_ranks, std::vector<int>{1});
}

TEST(SummaryFromFile, a_run_cut_off_in_its_warm_up_has_no_measured_frame) {
  io::RunData run = small_run();
  run.complete = false;
  run.attributes["state_hash"] = std::string(16, ' ');
  run.frame_measured = {false, false, false};
  const RunSummary summary = summary_from_file(run, "x.h5");
  EXPECT_FALSE(summary.complete);
  EXPECT_EQ(summary.measured_frames, 0);
  EXPECT_EQ(summary.warmup_frames, 3);
  EXPECT_EQ(summary.harmonic_mean_hz, 0);
  EXPECT_NE(to_text(summary).find("state_hash: none"), std::string::npos);
}

TEST(SummaryFromFile, a_missing_setting_is_named_with_its_file) {
  io::RunData run = small_run();
  run.parameters["dt"] = "soon";
  try {
    summary_from_file(run, "x.h5");
    FAIL() << "a dt that is no number went unnoticed";
  } catch (const core::InputError& error) {
    EXPECT_NE(std::string(error.what()).find("x.h5: /parameters has no number 'dt'"), std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace pbmpi::app
