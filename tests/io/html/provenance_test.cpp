#include "io/html/provenance.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace pbmpi::io::html {
namespace {

TEST(Provenance, as_json_ends_no_script) {
  const std::string text = provenance_json({"a", {{"name", "</script>"}}});
  EXPECT_EQ(text.find('<'), std::string::npos);
  EXPECT_EQ(nlohmann::json::parse(text)["entries"][0][1], "</script>");
}

}  // namespace
}  // namespace pbmpi::io::html
