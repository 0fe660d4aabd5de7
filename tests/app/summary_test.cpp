#include "app/summary/run_summary.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "mpi/spaces/plan/rank_groups.h"

namespace pbmpi::app {
namespace {

/// Two ranks, two measured frames of 2 ms and 6 ms; rank 0 computes 1 + 1 ms, rank 1 computes 2 + 4 ms.
MeasuredFrames two_frames() {
  MeasuredFrames frames;
  frames.wall_s = {0.002, 0.006};
  const auto solve = [](double seconds) {
    core::PhaseTimes times;
    times[core::Phase::solve] = seconds;
    times[core::Phase::wait] = 0.0005;
    return times.seconds;
  };
  frames.phases = {{solve(0.001), solve(0.001)}, {solve(0.002), solve(0.004)}};
  frames.islands = {3, 1};
  frames.contacts = {10, 30};
  frames.rows = {100, 120};
  frames.processor_s = {0.003, 0.007};
  return frames;
}

RunSummary computed() {
  RunSummary summary;
  summary.worlds = 4;
  summary.bodies = 40;
  summary.ranks = 2;
  summary.steps_per_frame = 3;
  summary.budget_s = 0.003;
  compute_performance(two_frames(), summary);
  return summary;
}

// The expected values follow by hand from the 8 ms above; 1e-12 is rounding of a few sums.
TEST(Summary, rates_come_from_the_elapsed_time) {
  const RunSummary summary = computed();
  EXPECT_NEAR(summary.harmonic_mean_hz, 2 / 0.008, 1e-9);
  EXPECT_NEAR(summary.world_steps_per_s, 2 * 3 * 4 / 0.008, 1e-9);
  EXPECT_NEAR(summary.body_steps_per_s, 2 * 3 * 40 / 0.008, 1e-8);
  EXPECT_DOUBLE_EQ(summary.satisfied_fraction, 0.5);
  EXPECT_DOUBLE_EQ(summary.frame_max_s, 0.006);
  EXPECT_NEAR(summary.frame_p50_s, 0.004, 1e-12);
}

TEST(Summary, efficiency_is_load_balance_times_communication) {
  const RunSummary summary = computed();
  EXPECT_NEAR(summary.load_balance, 0.004 / 0.006, 1e-12);              // mean of 2 and 6 ms over the larger
  EXPECT_NEAR(summary.communication_efficiency, 0.006 / 0.008, 1e-12);  // busiest rank over elapsed
  EXPECT_NEAR(summary.parallel_efficiency, 0.004 / 0.008, 1e-12);
}

TEST(Summary, phases_name_the_ranks_of_min_and_max) {
  const RunSummary summary = computed();
  ASSERT_EQ(summary.phases.size(), 2u) << "phases in which no rank spent time are left out";
  EXPECT_EQ(summary.phases[0].name, "solve");
  EXPECT_EQ(summary.phases[0].min_rank, 0);
  EXPECT_EQ(summary.phases[0].max_rank, 1);
  EXPECT_NEAR(summary.phases[0].max_s, 0.006, 1e-12);
  EXPECT_EQ(summary.phases[1].name, "wait");
}

TEST(Summary, processor_time_is_that_of_the_busiest_rank_in_a_frame) {
  const RunSummary summary = computed();
  EXPECT_DOUBLE_EQ(summary.processor.busiest_s, 0.0035);
  EXPECT_DOUBLE_EQ(summary.processor.mean_s, 0.0025);
  EXPECT_EQ(summary.processor.busiest_rank, 1);
  EXPECT_NE(
      to_text(summary).find("\nprocessor: 3.500 ms a frame on the busiest rank (1), 2.500 ms on the mean "
                            "one, without waiting\n"),
      std::string::npos);
  EXPECT_EQ(nlohmann::json::parse(to_json(summary))["processor_time"]["busiest_rank"], 1);
}

TEST(Summary, json_has_every_key_of_the_contract) {
  const auto json = nlohmann::json::parse(to_json(computed()));
  for (const char* key :
       {"program", "version", "scene", "worlds", "bodies", "ranks", "stepper", "iterations", "substeps",
        "precision", "dt", "steps_per_frame", "seed", "phases", "effects", "output", "state_hash"}) {
    EXPECT_TRUE(json.contains(key)) << key;
  }
  EXPECT_EQ(json["frames"]["measured"], 2);
  EXPECT_DOUBLE_EQ(json["islands"]["mean"], 2.0);
  EXPECT_DOUBLE_EQ(json["contacts"]["max"], 30.0);
  EXPECT_DOUBLE_EQ(json["frame_rate"]["budget_s"], 0.003);
  EXPECT_TRUE(json["invariants"].contains("max_penetration_m"));
  EXPECT_TRUE(json["throughput"].contains("world_steps_per_s_per_rank"));
}

TEST(Summary, text_has_greppable_lines) {
  RunSummary summary = computed();
  summary.state_hash = "0123456789abcdef";
  summary.idle_ranks = {1};
  const std::string text = to_text(summary);
  EXPECT_NE(text.find("\nstate_hash: 0123456789abcdef\n"), std::string::npos);
  EXPECT_NE(text.find("\nidle_ranks: 1 "), std::string::npos);
}

TEST(Summary, the_short_text_says_in_five_lines_what_one_asks_first) {
  RunSummary summary = computed();
  summary.scene = "CrashSk";
  summary.state_hash = "0123456789abcdef";
  summary.worlds_survived = 3;
  summary.max_joint_gap_m = 0.00753;
  const std::string text = to_short_text(summary, false);
  EXPECT_EQ(text.find("scene: CrashSk, 4 worlds with 40 bodies on 2 ranks; "), 0u);
  EXPECT_NE(text.find("\nspeed: 50 % of the frames within 3 ms; half take 4 ms, the longest 6 ms\n"),
            std::string::npos);
  EXPECT_NE(text.find("\naccuracy: joints gape by 7.53 mm"), std::string::npos);
  EXPECT_NE(text.find("\nfailed: 1 of 4 worlds did not survive\n"), std::string::npos);
  EXPECT_NE(text.find("\nstate_hash: 0123456789abcdef\n"), std::string::npos);
}

TEST(Summary, colours_are_for_terminals_alone) {
  RunSummary summary = computed();
  summary.worlds_survived = summary.worlds;
  EXPECT_EQ(to_short_text(summary, false).find('\033'), std::string::npos);
  EXPECT_NE(to_short_text(summary, true).find("failed: \033[32mnothing\033[0m"), std::string::npos);
}

/// One world cut into spaces: 8 ms of work on two ranks, of which 1 ms is root's section, in 5 ms.
RunSummary cut_into_spaces() {
  MeasuredFrames frames;
  core::PhaseTimes root, other;
  root[core::Phase::collide] = 0.001;
  root[core::Phase::solve] = 0.002;
  root[core::Phase::cross_space] = 0.001;
  root[core::Phase::ship] = 0.0005;
  other[core::Phase::collide] = 0.001;
  other[core::Phase::rows] = 0.003;
  frames.wall_s = {0.005};
  frames.phases = {{root.seconds}, {other.seconds}};
  frames.islands = {2};
  frames.contacts = {10};
  frames.rows = {100};
  frames.max_island_rows = {80};
  frames.messages = {12};
  frames.bytes = {6000};
  RunSummary summary;
  summary.decomposition = "spaces";
  summary.worlds = 1;
  summary.ranks = 2;
  summary.steps_per_frame = 3;
  compute_performance(frames, summary);
  return summary;
}

// Values follow by hand from the milliseconds above; 1e-12 is rounding.
TEST(Summary, bounds_a_world_cut_into_spaces_by_roots_section_and_the_largest_island) {
  const SpacesSummary spaces = cut_into_spaces().spaces;
  EXPECT_NEAR(spaces.serial_share, 1.0 / 8, 1e-12);
  EXPECT_NEAR(spaces.amdahl_bound, 7.0 / (1 + 7.0 / 2), 1e-12);
  EXPECT_NEAR(spaces.island_bound, 7.0 / (1 + 2.0 / 2 + 5 * 0.8), 1e-12);
  EXPECT_NEAR(spaces.speed_up, 7.0 / 5, 1e-12);
  EXPECT_NEAR(spaces.messages_per_step, 4, 1e-12);
  EXPECT_NEAR(spaces.bytes_per_step, 2000, 1e-9);
}

TEST(Summary, shows_the_phases_of_each_rank_of_a_world_cut_into_spaces) {
  const std::string text = to_text(cut_into_spaces());
  EXPECT_NE(text.find("\nrank: 0   collide 1.000 rows 0.000 solve 2.000 cross_space 1.000"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("\nrank: 1   collide 1.000 "), std::string::npos) << text;
  EXPECT_NE(text.find("\ntraffic: 4.0 messages and 2000 bytes a step\n"), std::string::npos) << text;
  const auto json = nlohmann::json::parse(to_json(cut_into_spaces()));
  EXPECT_EQ(json["decomposition"], "spaces");
  EXPECT_EQ(json["phases"][0]["by_rank_s"].size(), 2u);
  EXPECT_FALSE(nlohmann::json::parse(to_json(computed())).contains("spaces"));
}

/// The run as two worlds, each cut over one of the ranks or over both.
RunSummary cut_in_groups(const mpi::RankGroups& groups) {
  RunSummary summary = cut_into_spaces();
  summary.worlds = 2;
  summary.groups = groups;
  return summary;
}

TEST(Summary, says_which_groups_cut_worlds_of_their_own) {
  const std::string two = to_text(cut_in_groups({{1, 1}, {1, 1}}));
  EXPECT_NE(two.find("\ngroups: 2 groups of 1 rank, each cuts worlds of its own into spaces\n"),
            std::string::npos)
      << two;
  EXPECT_NE(two.find("(sections of the groups' roots)"), std::string::npos) << two;
  EXPECT_NE(to_text(cut_in_groups({{2}, {2}})).find("\ngroups: 1 group of 2 ranks,"), std::string::npos);
  const auto json = nlohmann::json::parse(to_json(cut_in_groups({{2, 1}, {3, 1}})));
  EXPECT_EQ(json["spaces"]["groups"],
            nlohmann::json::parse(R"([{"ranks":2,"worlds":3},{"ranks":1,"worlds":1}])"));
  EXPECT_FALSE(nlohmann::json::parse(to_json(cut_into_spaces()))["spaces"].contains("groups"));
}

TEST(Summary, bounds_groups_by_sections_that_are_done_side_by_side) {
  MeasuredFrames frames;
  core::PhaseTimes of_a_root;
  of_a_root[core::Phase::collide] = 0.002;
  of_a_root[core::Phase::solve] = 0.004;
  of_a_root[core::Phase::cross_space] = 0.001;
  frames.wall_s = {0.008};
  frames.phases = {{of_a_root.seconds}, {of_a_root.seconds}};
  frames.islands = frames.contacts = frames.messages = frames.bytes = {0};
  frames.rows = {100};
  frames.max_island_rows = {75};
  RunSummary summary;
  summary.decomposition = "spaces";
  summary.worlds = summary.ranks = 2;
  summary.steps_per_frame = 3;
  summary.groups = {{1, 1}, {1, 1}};
  compute_performance(frames, summary);
  // Values follow by hand from the milliseconds above; 1e-12 is rounding.
  EXPECT_NEAR(summary.spaces.serial_share, 2.0 / 14, 1e-12);
  EXPECT_NEAR(summary.spaces.amdahl_bound, 12.0 / (1 + 6), 1e-12);
  EXPECT_NEAR(summary.spaces.island_bound, 12.0 / (1 + 4.0 / 2 + 8 * 0.75), 1e-12);
  EXPECT_NEAR(summary.spaces.speed_up, 12.0 / 8, 1e-12);
}

TEST(Summary, reads_the_groups_that_a_file_names) {
  const mpi::RankGroups groups{{2, 2, 1}, {34, 33, 33}};
  EXPECT_EQ(to_text(groups), "2:34,2:33,1:33");
  const mpi::RankGroups read = mpi::rank_groups_from_text("2:34,2:33,1:33");
  EXPECT_EQ(read.ranks, groups.ranks);
  EXPECT_EQ(read.worlds, groups.worlds);
  EXPECT_EQ(in_words(groups), "3 groups of 1 to 2 ranks");
  for (const char* none : {"", "2", "2:", "0:3", "2;3", "two:3", "2:3,"})
    EXPECT_EQ(mpi::rank_groups_from_text(none).num_groups(), std::string(none) == "2:3," ? 1 : 0) << none;
}

TEST(Summary, no_measured_frame_divides_by_nothing) {
  RunSummary summary;
  compute_performance({}, summary);
  EXPECT_EQ(summary.harmonic_mean_hz, 0);
  EXPECT_EQ(summary.parallel_efficiency, 0);
}

}  // namespace
}  // namespace pbmpi::app
