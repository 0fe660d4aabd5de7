#include "scenes/xml/element.h"

#include <gtest/gtest.h>

#include "core/error.h"

namespace pbmpi::scenes::xml {
namespace {

TEST(Xml, knows_the_place_of_elements_and_attributes) {
  const Element root = parse(
      "<?xml version='1.0'?>\n<!-- a\ncomment --><a>\n  <b one='1'\n     two='2'/>text<c/></a>", "f.xml");
  EXPECT_EQ(root.name, "a");
  EXPECT_EQ(root.where, "f.xml:3:13");
  ASSERT_EQ(root.children.size(), 2u);
  EXPECT_EQ(root.children[0].where, "f.xml:4:4");
  ASSERT_NE(root.children[0].find("two"), nullptr);
  EXPECT_EQ(root.children[0].find("two")->where, "f.xml:5:6");
  EXPECT_EQ(root.children[0].find("two")->value, "2");
  EXPECT_EQ(root.children[0].find("three"), nullptr);
}

// The parser shortens text in place; the places of everything after it must stay right.
TEST(Xml, keeps_places_behind_entities_and_windows_line_ends) {
  const Element root = parse("<a x='&lt;&amp;&#65;'\r\n y='1'>\r\n<b/></a>", "f.xml");
  EXPECT_EQ(root.find("x")->value, "<&A");
  EXPECT_EQ(root.find("y")->where, "f.xml:2:2");
  EXPECT_EQ(root.children[0].where, "f.xml:3:2");
}

TEST(Xml, is_told_from_toml_by_its_first_character) {
  EXPECT_TRUE(is_xml("<a/>"));
  EXPECT_TRUE(is_xml("\xEF\xBB\xBF \n<a/>"));
  EXPECT_FALSE(is_xml("title = \"<a/>\""));
  EXPECT_FALSE(is_xml(""));
}

TEST(Xml, says_where_it_is_malformed) {
  const auto error_of = [](const std::string& text) -> std::string {
    try {
      parse(text, "f.xml");
      return "";
    } catch (const core::InputError& error) {
      return error.what();
    }
  };
  EXPECT_NE(error_of("<a>\n<b></a>").find("f.xml:2:"), std::string::npos);
  EXPECT_NE(error_of("<a b=1/>").find("f.xml:1:"), std::string::npos);
  EXPECT_NE(error_of(std::string("<a>\n\0</a>", 9)).find("f.xml:2:1: a zero byte"), std::string::npos);
  EXPECT_NE(error_of("").find("f.xml:1:1"), std::string::npos);
  EXPECT_NE(error_of("<a/><b/>").find("second root"), std::string::npos);
}

}  // namespace
}  // namespace pbmpi::scenes::xml
