#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "core/error.h"
#include "helpers.h"

namespace pbmpi::scenes {
namespace {

std::string error_of_find(const std::string& name) {
  try {
    find_scene(name);
  } catch (const core::InputError& error) {
    return error.what();
  }
  return "";
}

std::vector<std::string> names_in(SceneGroup group) {
  std::vector<std::string> names;
  for (const SceneInfo& scene : list_scenes(group)) {
    names.push_back(scene.name);
    EXPECT_FALSE(scene.title.empty()) << scene.name;
  }
  return names;
}

/// The nine scenes, those of effects, and exact motions.
std::vector<SceneInfo> no_hard_cases() {
  std::vector<SceneInfo> scenes = list_scenes(SceneGroup::paper);
  for (const SceneGroup group : {SceneGroup::effects, SceneGroup::exact})
    for (const SceneInfo& scene : list_scenes(group)) scenes.push_back(scene);
  return scenes;
}

TEST(Catalog, lists_the_scenes_in_the_order_of_the_papers_table) {
  EXPECT_EQ(names_in(SceneGroup::paper),
            (std::vector<std::string>{"2-Cars", "10-Cars", "CrashSk", "CrashWa", "Environ", "100CrSk",
                                      "Battle", "Fight", "Battle2"}));
}

TEST(Catalog, lists_the_scenes_of_effects_by_their_names_alone) {
  EXPECT_EQ(names_in(SceneGroup::effects),
            (std::vector<std::string>{"Bowling", "Feathers", "Stadium", "Warehouse"}));
}

TEST(Catalog, every_scene_that_it_lists_builds_a_valid_first_and_last_world) {
  for (const SceneInfo& info : no_hard_cases()) {
    const auto scene = parse_scene(find_scene(info.name));
    EXPECT_EQ(scene->name(), info.name);
    EXPECT_EQ(scene->title(), info.title);
    EXPECT_GT(scene->build(0, 1)->num_bodies(), 0) << info.name;
    EXPECT_GT(scene->build(scene->defaults().replicas - 1, 1)->num_bodies(), 0) << info.name;
  }
}

TEST(Catalog, suggests_the_nearest_names_for_an_unknown_scene) {
  const std::string message = error_of_find("20-cars");
  EXPECT_NE(message.find("unknown scene '20-cars'; did you mean '2-Cars' or '10-Cars'?"), std::string::npos)
      << message;
}

TEST(Catalog, lists_all_scenes_when_no_name_is_near) {
  EXPECT_NE(error_of_find("Waterfall")
                .find("known: '2-Cars', '10-Cars', 'CrashSk', 'CrashWa', 'Environ', '100CrSk', "
                      "'Battle', 'Fight', 'Battle2'"),
            std::string::npos);
}

TEST(Catalog, holds_the_scene_files_word_for_word) {
  const std::string folder = std::string(PBMPI_TEST_SCENES) + "/../../scenes/";
  for (const auto& [group, below] :
       {std::pair(SceneGroup::paper, ""), {SceneGroup::effects, "effects/"}, {SceneGroup::exact, ""}}) {
    for (const std::string& name : names_in(group)) {
      const std::string path = folder + below + name + ".toml";
      EXPECT_EQ(find_scene(name).text, find_scene(path).text) << name;
    }
  }
}

TEST(Catalog, reads_a_users_own_file_by_its_path) {
  const SceneSource source = find_scene(std::string(PBMPI_TEST_SCENES) + "/Unequal.toml");
  EXPECT_EQ(source.name, "Unequal");
  const auto scene = parse_scene(source);
  EXPECT_EQ(scene->defaults().replicas, 16);
  EXPECT_EQ(scene->text(), source.text);
}

TEST(Catalog, refuses_a_file_that_is_not_there_and_a_folder) {
  EXPECT_NE(
      error_of_find("no/such/file.toml").find("no/such/file.toml: cannot be read: there is no such file"),
      std::string::npos);
  const auto folder = std::filesystem::path(testing::TempDir()) / "folder.toml";
  std::filesystem::create_directories(folder);
  EXPECT_NE(error_of_find(folder.string()).find("it is a directory"), std::string::npos);
}

TEST(Catalog, takes_any_text_of_a_model_file_into_its_scene) {
  const auto folder = std::filesystem::path(testing::TempDir());
  const auto path = folder / "yard_of_any.toml";
  std::ofstream(path) << "title = 't'\n[[actor]]\nname = 'm'\ntype = 'model'\nfile = 'any \"robot\".xml'\n";
  for (const std::string comment :
       {"'''", "\"\"\"", "\\", "\r\n", "\xe9", "\xc3\xa9", "\t\x7f", "]\n[case]\n"}) {
    // The first line break counts as well: the error is in the fourth line.
    const std::string text =
        "\n<mujoco><!-- " + comment +
        " -->\n<worldbody><body name='b'><freejoint/><geom size='1'/></body></worldbody>\n";
    std::ofstream(folder / "any \"robot\".xml", std::ios::binary) << text << "</mujoco>";
    EXPECT_EQ(parse_scene(find_scene(path.string()))->build(0, 1)->num_bodies(), 1) << comment;
    std::ofstream(folder / "any \"robot\".xml", std::ios::binary) << text << "<worldbdy/></mujoco>";
    const int line = 4 + static_cast<int>(std::ranges::count(comment, '\n'));
    try {
      parse_scene(find_scene(path.string()));
      FAIL() << "a broken model was accepted";
    } catch (const core::InputError& error) {
      EXPECT_EQ(std::string(error.what()).find("any \"robot\".xml:" + std::to_string(line) + ":2:"), 0u)
          << error.what();
    }
  }
}

TEST(Catalog, names_a_users_file_in_the_errors_of_its_content) {
  const auto path = std::filesystem::path(testing::TempDir()) / "broken.toml";
  std::ofstream(path) << "title = \"t\"\nreplicas = \n";
  try {
    parse_scene(find_scene(path.string()));
    FAIL() << "a broken file was accepted";
  } catch (const core::InputError& error) {
    EXPECT_EQ(std::string(error.what()).find(path.string() + ":2:"), 0u) << error.what();
  }
}

}  // namespace
}  // namespace pbmpi::scenes
