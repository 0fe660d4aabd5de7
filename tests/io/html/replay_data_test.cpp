#include "io/html/replay_data.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "io/html/base64.h"
#include "page_sample.h"

namespace pbmpi::io::html {
namespace {

/// Bytes of so many bodies in so many frames, one of which is the initial pose.
std::int64_t room_for(std::int64_t bodies, std::int64_t frames) { return pose_bytes(bodies * frames); }

std::int64_t bodies_of(const RunData& run) { return static_cast<std::int64_t>(run.bodies.id.size()); }

TEST(ReplayData, takes_everything_that_fits) {
  const RunData run = sample_run({.num_worlds = 3, .num_records = 8});
  const Selection all = select_replay(run, room_for(bodies_of(run), 9));
  EXPECT_EQ(all.num_worlds, 3);
  EXPECT_EQ(all.num_bodies, bodies_of(run));
  EXPECT_EQ(all.records.size(), 8u);
  EXPECT_EQ(all.note, "");
}

TEST(ReplayData, leaves_out_the_last_worlds_first_and_says_so) {
  const RunData run = sample_run({.num_worlds = 3, .num_records = 8});
  const std::int64_t per_world = bodies_of(run) / 3;
  const Selection some = select_replay(run, room_for(2 * per_world, 9));
  EXPECT_EQ(some.num_worlds, 2);
  EXPECT_EQ(some.num_bodies, 2 * per_world);
  EXPECT_EQ(some.records.size(), 8u);
  EXPECT_NE(some.note.find("the first 2 of 3 worlds"), std::string::npos) << some.note;
}

TEST(ReplayData, thins_the_frames_of_one_world_and_keeps_the_last) {
  const RunData run = sample_run({.num_worlds = 1, .num_records = 11});
  const Selection thin = select_replay(run, room_for(bodies_of(run), 5));
  EXPECT_EQ(thin.records, (std::vector<std::size_t>{1, 4, 7, 10}));
  EXPECT_NE(thin.note.find("4 of 11 recorded frames"), std::string::npos) << thin.note;
}

TEST(ReplayData, thins_a_long_run_before_it_leaves_out_worlds) {
  RunData run = sample_run({.num_worlds = 2, .num_records = 1});
  run.position.resize(3 * preferred_records, run.position.front());
  const Selection some = select_replay(run, room_for(bodies_of(run), preferred_records + 1));
  EXPECT_EQ(some.num_worlds, 2);
  EXPECT_EQ(some.records.size(), preferred_records);
  EXPECT_EQ(some.records.back(), run.position.size() - 1);
}

TEST(ReplayData, shows_the_end_of_one_world_in_the_least_room) {
  const RunData run = sample_run({.num_worlds = 2, .num_records = 8});
  const Selection least = select_replay(run, 1);
  EXPECT_EQ(least.num_worlds, 1);
  EXPECT_EQ(least.records, (std::vector<std::size_t>{7}));
}

TEST(ReplayData, a_run_without_a_frame_shows_its_initial_pose) {
  const RunData run = sample_run({.num_worlds = 1, .num_records = 0});
  const Selection none = select_replay(run, 1'000'000);
  EXPECT_TRUE(none.records.empty());
  const auto replay = nlohmann::json::parse(replay_json(run, none));
  EXPECT_EQ(replay["time_s"].size(), 1u);
}

TEST(ReplayData, poses_take_the_room_that_is_counted_for_them) {
  const RunData run = sample_run({.num_worlds = 2, .num_records = 8});
  const Selection all = select_replay(run, 28'000'000);
  const auto replay = nlohmann::json::parse(replay_json(run, all));
  const auto length =
      replay["position"].get<std::string>().size() + replay["orientation"].get<std::string>().size();
  // Base64 pads each of the two arrays by at most 4 characters.
  EXPECT_NEAR(static_cast<double>(length), static_cast<double>(pose_bytes(all.num_bodies * 9)), 8);
}

TEST(ReplayData, the_first_frame_is_the_initial_pose) {
  const RunData run = sample_run({.num_worlds = 1, .num_records = 2});
  const auto replay = nlohmann::json::parse(replay_json(run, select_replay(run, 28'000'000)));
  std::vector<float> first;
  for (int k = 0; k < 3; ++k) first.push_back(static_cast<float>(run.bodies.initial[0].position[k]));
  // Three floats are 12 bytes: 16 characters that no neighbour shares.
  EXPECT_EQ(replay["position"].get<std::string>().substr(0, 16), base64_of(first));
}

TEST(ReplayData, numbers_frames_as_the_plots_do) {
  RunData run = sample_run({.num_records = 3});
  const auto numbers = [&] {
    return nlohmann::json::parse(replay_json(run, select_replay(run, 1'000'000'000)))["number"];
  };
  EXPECT_EQ(numbers(), (std::vector<int>{0, 1, 2, 3}));
  run.attributes["record_every"] = "5";
  run.attributes["first_frame"] = "30";
  EXPECT_EQ(numbers(), (std::vector<int>{0, 35, 40, 45}))
      << "the start, then every fifth frame after the thirtieth";
}

TEST(ReplayData, carries_the_geoms_of_the_shown_worlds_only) {
  const RunData run = sample_run({.num_worlds = 2, .num_records = 8});
  const Selection one = select_replay(run, room_for(bodies_of(run) / 2, 9));
  ASSERT_EQ(one.num_worlds, 1);
  const auto replay = nlohmann::json::parse(replay_json(run, one));
  EXPECT_EQ(static_cast<std::int64_t>(replay["geoms"]["kind"].get<std::string>().size()),
            base64_length(static_cast<std::int64_t>(run.geoms.size() / 2)));
}

}  // namespace
}  // namespace pbmpi::io::html
