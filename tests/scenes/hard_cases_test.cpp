// The hard cases that come with pbmpi: scenes/hard.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include "core/error.h"
#include "helpers.h"

namespace pbmpi::scenes {
namespace {

namespace fs = std::filesystem;

const fs::path folder = fs::path(PBMPI_TEST_SCENES) / ".." / ".." / "scenes" / "hard";

class EachHardCase : public testing::TestWithParam<std::string> {};

TEST_P(EachHardCase, builds_a_world_and_says_what_should_happen_in_it) {
  const auto scene = parse_scene(find_scene(GetParam()));
  EXPECT_EQ(scene->name(), GetParam());
  EXPECT_FALSE(scene->title().empty());
  ASSERT_TRUE(scene->hard_case());
  const stability::HardCase& hard = *scene->hard_case();
  EXPECT_FALSE(hard.source.empty());
  EXPECT_FALSE(hard.oracle.empty());
  EXPECT_GT(hard.bounds.size() + hard.expectations.size(), 0u);
  EXPECT_EQ("hard/" + hard.group, fs::path(GetParam()).parent_path()) << "the group is the folder's name";
  const auto model = scene->build(0, 1);
  EXPECT_GT(model->num_bodies(), 0);
  const Vec3 low = hard.region.low, high = hard.region.high;
  for (const model::Body& one : model->bodies) {
    const Vec3& p = one.pose.position;
    EXPECT_TRUE((p.array() >= low.array()).all() && (p.array() <= high.array()).all())
        << one.name << " starts outside of the region";
  }
}

std::vector<std::string> names_of_cases() {
  std::vector<std::string> names;
  for (const SceneInfo& info : list_scenes(SceneGroup::hard)) names.push_back(info.name);
  return names;
}

INSTANTIATE_TEST_SUITE_P(All, EachHardCase, testing::ValuesIn(names_of_cases()), [](const auto& instance) {
  std::string name = instance.param.substr(std::string("hard/").size());
  std::replace_if(
      name.begin(), name.end(), [](char c) { return c == '/' || c == '-'; }, '_');
  return name;
});

TEST(HardCases, cover_every_row_of_the_list) {
  std::set<int> rows;
  for (const std::string& name : names_of_cases())
    rows.insert(parse_scene(find_scene(name))->hard_case()->row);
  for (int row = 1; row <= 30; ++row) {
    const bool is_an_axis = row == 29;  // the step length, which the study varies
    EXPECT_EQ(rows.contains(row), !is_an_axis) << "row " << row;
  }
  EXPECT_GE(names_of_cases().size(), 65u);
}

TEST(HardCases, are_the_files_word_for_word_and_at_most_25_a_folder) {
  std::map<std::string, int> in_folder;
  std::set<std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file()) continue;
    const fs::path name = "hard" / fs::relative(entry.path(), folder).replace_extension();
    files.insert(name.string());
    EXPECT_LE(++in_folder[name.parent_path().string()], 25) << name;
    EXPECT_EQ(find_scene(name.string()).text, find_scene(entry.path().string()).text) << name;
  }
  const std::vector<std::string> names = names_of_cases();
  EXPECT_EQ(files, std::set<std::string>(names.begin(), names.end()));
}

TEST(HardCases, do_not_show_up_among_the_papers_scenes) {
  EXPECT_EQ(list_scenes(SceneGroup::paper).size(), 9u);
}

std::string error_of_find(const std::string& name) {
  try {
    find_scene(name);
  } catch (const core::InputError& error) {
    return error.what();
  }
  return "";
}

TEST(HardCases, are_suggested_by_the_nearest_names_alone) {
  EXPECT_NE(error_of_find("hard/rest/colum10").find("did you mean 'hard/rest/column10'"), std::string::npos);
  EXPECT_EQ(error_of_find("hard/waterfall"),
            "unknown scene 'hard/waterfall' (--list-scenes shows all; a scene file of your own ends in "
            ".toml, .xml or .urdf)");
}

}  // namespace
}  // namespace pbmpi::scenes
