#include "scenes/xml/include.h"

#include <gtest/gtest.h>

#include "core/error.h"

namespace pbmpi::scenes::xml {
namespace {

Element expanded(const Texts& texts, Notes& notes, const std::set<std::string>& leave_out = {}) {
  const std::string main = "robots/dog.xml";
  Element root = parse(texts.at(main), main);
  expand_includes(root, main, texts, LeaveOut(leave_out, notes));
  return root;
}

std::string refusal(const Texts& texts) {
  Notes notes;
  try {
    expanded(texts, notes);
    return "";
  } catch (const core::InputError& error) {
    return error.what();
  }
}

TEST(Include, puts_what_the_root_holds_in_the_place_of_the_element) {
  Notes notes;
  const Texts texts = {{"robots/dog.xml", "<mujoco><a/><b><include file='parts/leg.xml'/><c/></b></mujoco>"},
                       {"robots/parts/leg.xml", "<anything><d/>\n<include file='./foot.xml'/></anything>"},
                       {"robots/foot.xml", "<x><e/><f/></x>"}};
  const Element root = expanded(texts, notes);
  ASSERT_EQ(root.children.size(), 2u);
  const Element& b = root.children[1];
  ASSERT_EQ(b.children.size(), 4u);
  EXPECT_EQ(b.children[0].where, "robots/parts/leg.xml:1:12");
  EXPECT_EQ(b.children[1].name, "e");
  EXPECT_EQ(b.children[2].where, "robots/foot.xml:1:9");
  EXPECT_EQ(b.children[3].name, "c");
  const auto files = files_in(texts.at("robots/dog.xml"), {"robots/dog.xml", "robots/dog.xml"});
  ASSERT_EQ(files.size(), 1u);
  EXPECT_EQ(files[0].file, "robots/parts/leg.xml");
  EXPECT_EQ(files[0].main, "robots/dog.xml");
}

TEST(Include, stays_in_the_folder_and_ends) {
  const auto with = [](const std::string& file) {
    return Texts{{"robots/dog.xml", "<mujoco><include file='" + file + "'/></mujoco>"},
                 {"robots/a.xml", "<x>\n<include file='b.xml'/></x>"},
                 {"robots/b.xml", "<x><include file='a.xml'/></x>"}};
  };
  for (const char* outside : {"../cat.xml", "/etc/passwd", "parts/../../cat.xml", "", ".."})
    EXPECT_NE(refusal(with(outside)).find("robots/dog.xml:1:18"), std::string::npos)
        << refusal(with(outside));
  EXPECT_NE(refusal(with("a.xml")).find("robots/b.xml:1:5: 'robots/a.xml' is included a second time"),
            std::string::npos)
      << refusal(with("a.xml"));
  EXPECT_NE(refusal(with("dog.xml")).find("second time"), std::string::npos);
  EXPECT_NE(refusal(with("c.xml")).find("no text of 'robots/c.xml'"), std::string::npos);
}

TEST(Include, names_the_models_to_attach_whose_own_folder_counts_for_them) {
  const auto files = files_in("<mujoco><asset><model file='parts/leg.xml'/></asset></mujoco>",
                              {"robots/dog.xml", "robots/dog.xml"});
  ASSERT_EQ(files.size(), 1u);
  EXPECT_EQ(files[0].file, "robots/parts/leg.xml");
  EXPECT_EQ(files[0].main, "robots/parts/leg.xml");
}

TEST(Include, can_be_left_out) {
  Notes notes;
  EXPECT_TRUE(expanded({{"robots/dog.xml", "<mujoco><include file='c.xml'/></mujoco>"}}, notes, {"include"})
                  .children.empty());
  EXPECT_EQ(notes.lines().size(), 1u);
}

}  // namespace
}  // namespace pbmpi::scenes::xml
