#include "solver/contact_colors.h"

#include <gtest/gtest.h>

#include <set>

#include "core/random.h"
#include "model/model.h"

namespace pbmpi::solver {
namespace {

using Links = std::vector<std::pair<int, int>>;

Links random_links(int num_bodies, int count, std::uint64_t seed) {
  Links links;
  for (int i = 0; i < count; ++i) {
    const auto key = core::mix_key(seed, static_cast<std::uint64_t>(i), 0);
    const int a = static_cast<int>(key % static_cast<std::uint64_t>(num_bodies));
    const int b =
        static_cast<int>((key >> 32) % static_cast<std::uint64_t>(num_bodies + 1)) - 1;  // -1 = no_body
    if (a != b) links.emplace_back(a, b);
  }
  return links;
}

void expect_proper(int num_bodies, const Links& links) {
  ContactColors painter;
  std::vector<int> colors;
  const int count = painter.paint(num_bodies, links, colors);
  ASSERT_EQ(colors.size(), links.size());
  std::set<std::pair<int, int>> seen;  // (colour, body)
  for (std::size_t i = 0; i < links.size(); ++i) {
    EXPECT_GE(colors[i], 0);
    EXPECT_LT(colors[i], count);
    EXPECT_TRUE(seen.emplace(colors[i], links[i].first).second) << "contact " << i;
    if (links[i].second == model::no_body) continue;
    EXPECT_TRUE(seen.emplace(colors[i], links[i].second).second) << "contact " << i;
  }
}

TEST(ContactColors, no_two_contacts_of_a_colour_share_a_body) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) expect_proper(30, random_links(30, 200, seed));
}

TEST(ContactColors, a_body_with_hundreds_of_contacts_gets_a_colour_for_each) {
  expect_proper(4, random_links(4, 700, 3));  // far more than the 64 of a mask
}

TEST(ContactColors, the_environment_blocks_nothing) {
  ContactColors painter;
  std::vector<int> colors;
  EXPECT_EQ(painter.paint(3, Links{{0, model::no_body}, {1, model::no_body}, {2, model::no_body}}, colors),
            1);
}

TEST(ContactColors, no_contact_needs_no_colour) {
  ContactColors painter;
  std::vector<int> colors{1, 2};
  EXPECT_EQ(painter.paint(3, Links{}, colors), 0);
  EXPECT_TRUE(colors.empty());
}

}  // namespace
}  // namespace pbmpi::solver
