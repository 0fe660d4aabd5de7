#include "io/html/provenance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

namespace pbmpi::io::html {
namespace {

const std::map<std::string, std::string> attributes = {{"pbmpi_version", "1.2"},
                                                       {"git_revision", "abc"},
                                                       {"created", "today"},
                                                       {"command_line", "pbstudy effects"},
                                                       {"state_hash", "0123"}};

bool has(const Provenance& provenance, const std::string& name, const std::string& text) {
  return std::ranges::count(provenance.entries, std::pair(name, text)) == 1;
}

TEST(Provenance, of_several_runs_has_a_line_for_each) {
  const Provenance provenance = provenance_of({{"one.h5", attributes}, {"two.h5", {}}}, "pbreport 1.3");
  EXPECT_EQ(provenance.line, "2 runs · page by pbreport 1.3");
  EXPECT_TRUE(has(provenance, "one.h5", "pbstudy effects · pbmpi 1.2 · abc · today · state 0123"));
  EXPECT_TRUE(has(provenance, "two.h5", "")) << "a file that says nothing is named all the same";
}

TEST(Provenance, as_json_ends_no_script) {
  const std::string text = provenance_json({"a", {{"name", "</script>"}}});
  EXPECT_EQ(text.find('<'), std::string::npos);
  EXPECT_EQ(nlohmann::json::parse(text)["entries"][0][1], "</script>");
}

}  // namespace
}  // namespace pbmpi::io::html
