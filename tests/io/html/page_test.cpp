#include "io/html/page.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "core/error.h"
#include "io/html/assets.h"
#include "io/html/escape.h"
#include "page_sample.h"

#include <nlohmann/json.hpp>

namespace pbmpi::io::html {
namespace {

std::size_t count(const std::string& text, const std::string& what) {
  std::size_t found = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++found;
  return found;
}

std::string data_block(const std::string& page, const std::string& id) {
  const std::size_t begin = page.find('>', page.find("id=\"" + id + "\"")) + 1;
  return page.substr(begin, page.find("</script>", begin) - begin);
}

TEST(Page, no_text_of_the_user_ends_a_script_or_opens_a_tag) {
  const std::string page = make_page(sample_run(), {});  // scene and command line hold '<' and "</script>"
  EXPECT_EQ(count(page, "<script"), count(page, "</script>"));
  EXPECT_EQ(count(page, "Sample <crash>"), 0u);
  EXPECT_EQ(nlohmann::json::parse(data_block(page, "about-data"))["attributes"]["command_line"],
            "pbmpi --scene \"Sample </script>\"");
}

TEST(Page, loads_nothing_from_the_network) {
  const std::string page = make_page(sample_run(), {});
  for (const char* loader : {"src=\"http", "href=\"http", "url(http", "@import", "src='http", "href='http"}) {
    EXPECT_EQ(count(page, loader), 0u) << loader;
  }
}

TEST(Page, every_data_block_is_json) {
  const std::string page = make_page(sample_run(), {});
  for (const char* id : {"about-data", "plots-data", "replay-data"}) {
    EXPECT_TRUE(nlohmann::json::accept(data_block(page, id))) << id;
  }
}

TEST(Page, stays_within_its_room_for_poses) {
  PageOptions small;
  small.max_pose_bytes = 100'000;
  const auto run = sample_run({.num_worlds = 40, .num_records = 30});
  const std::string page = make_page(run, small);
  const auto replay = nlohmann::json::parse(data_block(page, "replay-data"));
  EXPECT_LE(replay["position"].get<std::string>().size() + replay["orientation"].get<std::string>().size(),
            100'008u);  // base64 pads each of the two arrays
  EXPECT_NE(replay["note"].get<std::string>(), "");
}

TEST(Page, an_unwritable_place_is_refused_and_left_empty) {
  const std::string path = testing::TempDir() + "no-such-folder/page.html";
  try {
    write_page(path, sample_run(), {});
    FAIL() << "writing into a missing folder went unnoticed";
  } catch (const core::InputError& error) {
    EXPECT_NE(std::string(error.what()).find(path), std::string::npos) << error.what();
  }
}

TEST(Page, a_written_page_is_the_text_and_leaves_no_other_file) {
  const std::string folder = testing::TempDir() + "pbmpi-page-test";
  std::filesystem::remove_all(folder);
  std::filesystem::create_directory(folder);
  write_page(folder + "/page.html", sample_run(), {});
  std::ifstream file(folder + "/page.html", std::ios::binary);
  std::stringstream text;
  text << file.rdbuf();
  EXPECT_EQ(text.str(), make_page(sample_run(), {}));
  const auto entries = std::filesystem::directory_iterator(folder);
  EXPECT_EQ(std::distance(begin(entries), end(entries)), 1);
  std::filesystem::remove_all(folder);
}

TEST(Page, a_folder_in_the_page_s_place_is_refused) {
  const std::string folder = testing::TempDir() + "pbmpi-page-folder";
  std::filesystem::create_directories(folder);
  EXPECT_THROW(write_page(folder, sample_run(), {}), core::InputError);
  EXPECT_FALSE(std::filesystem::exists(folder + ".part"));
  std::filesystem::remove_all(folder);
}

TEST(Assets, hold_the_libraries_and_refuse_unknown_names) {
  EXPECT_NE(asset("three_js").find("WebGLRenderer"), std::string_view::npos);
  EXPECT_NE(asset("chart_js").find("Chart.js v"), std::string_view::npos);
  EXPECT_THROW(asset("nothing_js"), std::logic_error);
}

TEST(Escape, writes_the_five_characters_of_html) {
  EXPECT_EQ(escape_html("<a href=\"x\">'&"), "&lt;a href=&quot;x&quot;&gt;&#39;&amp;");
}

}  // namespace
}  // namespace pbmpi::io::html
