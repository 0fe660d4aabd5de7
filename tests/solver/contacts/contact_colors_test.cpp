#include "solver/contacts/contact_colors.h"

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

std::vector<int> paint(int num_bodies, const Links& links) {
  ContactColors painter;
  painter.start(num_bodies);
  std::vector<int> colors;
  for (const auto& [a, b] : links) colors.push_back(painter.paint(a, b));
  return colors;
}

void expect_proper(int num_bodies, const Links& links) {
  const std::vector<int> colors = paint(num_bodies, links);
  std::set<std::pair<int, int>> seen;  // (colour, body)
  for (std::size_t i = 0; i < links.size(); ++i) {
    EXPECT_GE(colors[i], 0);
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
  EXPECT_EQ(paint(3, {{0, model::no_body}, {1, model::no_body}, {2, model::no_body}}),
            (std::vector<int>{0, 0, 0}));
}

TEST(ContactColors, a_contact_takes_the_lowest_colour_that_both_bodies_have_left) {
  EXPECT_EQ(paint(4, {{0, 1}, {1, 2}, {2, 3}, {0, 3}, {0, 2}}), (std::vector<int>{0, 1, 0, 1, 2}));
}

TEST(ContactColors, a_start_forgets_what_was_painted) {
  ContactColors painter;
  painter.start(2);
  EXPECT_EQ(painter.paint(0, 1), 0);
  painter.start(2);
  EXPECT_EQ(painter.paint(0, 1), 0);
}

}  // namespace
}  // namespace pbmpi::solver
