#include "app/pbreport/instructions/direct_cost.h"

#include <gtest/gtest.h>

#include <unistd.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "core/error.h"

namespace pbmpi::app {
namespace {

IslandWork work_of(const std::string& scene, const std::vector<std::vector<SolvedIsland>>& frames) {
  IslandWork work;
  work.scene = scene;
  work.steps_per_frame = 3;
  work.islands = frames;
  return work;
}

InstructionCounts counts(double per_frame, double collision_share) {
  return {per_frame, collision_share, {}, 5};
}

TEST(DirectCost, cubes_are_those_of_all_islands_and_steps) {
  const IslandWork work = work_of("Fight", {{{10, 0}, {20, 0}}, {{30, 0}}});
  EXPECT_EQ(work.cubed_rows(), 3 * (1000 + 8000 + 27000) / 2.0);
  EXPECT_EQ(IslandWork().cubed_rows(), 0);
}

TEST(DirectCost, of_scenes_spans_their_ratios) {
  const auto cost = cubic_cost(std::array{1.0, 4.0, 2.0});
  ASSERT_TRUE(cost);
  EXPECT_EQ(cost->least, 1);
  EXPECT_EQ(cost->most, 4);
  EXPECT_NEAR(cost->middle, 2, 1e-15);  // rounding
  EXPECT_EQ(cost->num_scenes, 3);
  EXPECT_FALSE(cubic_cost({}));
}

TEST(DirectCost, is_extrapolated_from_scenes_with_a_large_island) {
  const std::vector<IslandWork> works = {work_of("2-Cars", {{{40, 0}}}), work_of("Fight", {{{200, 0}}}),
                                         work_of("Environ", {{{1000, 0}}})};
  const double cubes = 3 * 8e6;
  const std::vector<CountedScene> scenes = {{"2-Cars", counts(1e6, 0.1), counts(9e9, 0)},
                                            {"Fight", counts(1e6, 0.1), counts(2 * cubes / 0.5, 0.5)},
                                            {"Environ", counts(1e7, 0.2), std::nullopt}};
  const auto cost = counted_cost(scenes, works);
  ASSERT_TRUE(cost);
  EXPECT_EQ(cost->num_scenes, 1) << "the island of 2-Cars is too small to tell";
  EXPECT_NEAR(cost->middle, 2, 1e-12);  // rounding
  const auto environ = direct_cost(scenes[2], cost, works);
  ASSERT_TRUE(environ);
  EXPECT_FALSE(environ->is_counted);
  EXPECT_NEAR(environ->middle, 2 * 3e9 + 2e6, 1e-3) << "the solver, and quick's collision detection";
  const auto fight = direct_cost(scenes[1], cost, works);
  EXPECT_TRUE(fight->is_counted);
  EXPECT_EQ(fight->least, scenes[1].direct->per_frame);
  EXPECT_FALSE(direct_cost(scenes[2], std::nullopt, works));
  EXPECT_FALSE(direct_cost(scenes[2], cost, {}));
}

class CountsFile : public ::testing::Test {
 protected:
  CountsFile() : path_((std::filesystem::temp_directory_path() / "pbmpi-counts-XXXXXX").string()) {
    ::close(::mkstemp(path_.data()));
  }
  ~CountsFile() override { std::filesystem::remove(path_); }
  void write(const std::string& text) { std::ofstream(path_) << text; }

  std::string path_;
};

const char* const whole = R"({"filetype": "pbmpi-instructions", "scenes": {"Fight": {"quick":
  {"instructions_per_frame": 2e6, "collision_share": 0.25, "frames": 5,
   "mix": {"floating point": 0.3, "integer": 0.2, "branch": 0.1, "store": 0.1, "load": 0.3}}}}})";

TEST_F(CountsFile, is_read_scene_by_scene) {
  write(whole);
  EXPECT_TRUE(has_counts(path_));
  const std::vector<CountedScene> scenes = read_counts(path_);
  ASSERT_EQ(scenes.size(), 1u);
  EXPECT_EQ(scenes[0].name, "Fight");
  ASSERT_TRUE(scenes[0].quick);
  EXPECT_FALSE(scenes[0].direct);
  EXPECT_EQ(scenes[0].quick->solver(), 1.5e6);
  EXPECT_EQ(scenes[0].quick->mix, (InstructionMix{0.3, 0.2, 0.1, 0.1, 0.3}));
}

TEST_F(CountsFile, is_refused_if_it_is_another_one_or_lacks_a_number) {
  for (const std::string text : {"", "[1]", "{}", R"({"filetype": "x", "scenes": {}})"}) {
    write(text);
    EXPECT_FALSE(has_counts(path_)) << text;
    EXPECT_THROW(read_counts(path_), core::InputError) << text;
  }
  std::string lacking = whole;
  lacking.replace(lacking.find("frames"), 6, "farmes");
  write(lacking);
  EXPECT_TRUE(has_counts(path_));
  EXPECT_THROW(read_counts(path_), core::InputError);
  write(R"({"filetype": "pbmpi-instructions", "scenes": {}})");
  EXPECT_THROW(read_counts(path_), core::InputError);
}

}  // namespace
}  // namespace pbmpi::app
