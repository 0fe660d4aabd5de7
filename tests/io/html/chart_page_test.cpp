#include "io/html/chart_page.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/error.h"

namespace pbmpi::io::html {
namespace {

ChartPage sample() {
  PageSection section;
  section.title = "Scene </script>";
  section.text = "one\n\ntwo";
  section.charts = {
      {"Errors", "less is better", R"({"type": "bar", "data": {"labels": [], "datasets": []}})"}};
  section.tables = {{"Numbers", {"a", "b"}, {{"1", "<2"}}}};
  return {"A & B", "from <file>", {section}};
}

TEST(ChartPage, holds_what_it_was_given_as_json_that_ends_no_script) {
  const std::string page = make_chart_page(sample());
  EXPECT_EQ(page.find("{{"), page.find("{{", page.find("<script>")))
      << "no field is left open before the scripts";
  EXPECT_NE(page.find("<h1>A &amp; B</h1>"), std::string::npos);
  const std::string open = "<script type=\"application/json\" id=\"sections-data\">";
  const std::size_t begin = page.find(open) + open.size();
  const std::string data = page.substr(begin, page.find("</script>", begin) - begin);
  const auto sections = nlohmann::json::parse(data);
  ASSERT_EQ(sections.size(), 1u);
  EXPECT_EQ(sections[0]["title"], "Scene </script>");
  EXPECT_EQ(sections[0]["charts"][0]["config"]["type"], "bar");
  EXPECT_EQ(sections[0]["tables"][0]["rows"][0][1], "<2");
}

TEST(ChartPage, loads_nothing_from_the_network) {
  const std::string page = make_chart_page(sample());
  EXPECT_EQ(page.find("src=\"http"), std::string::npos);
  EXPECT_EQ(page.find("href=\"http"), std::string::npos);
}

TEST(ChartPage, a_place_that_cannot_be_written_is_the_users_to_mend) {
  EXPECT_THROW(write_chart_page("/no/such/folder/page.html", sample()), core::InputError);
}

}  // namespace
}  // namespace pbmpi::io::html
