#include "model/islands.h"

#include <gtest/gtest.h>

#include "core/random.h"
#include "model/model.h"

namespace pbmpi::model {
namespace {

using Links = std::vector<std::pair<int, int>>;

/// Propagates the lowest labels along the links until nothing changes.
std::vector<int> lowest_reachable(int num_bodies, const Links& links) {
  std::vector<int> label(static_cast<std::size_t>(num_bodies));
  for (int i = 0; i < num_bodies; ++i) label[i] = i;
  for (bool changed = true; changed;) {
    changed = false;
    for (const auto& [a, b] : links) {
      if (a == no_body || b == no_body || label[a] == label[b]) continue;
      label[a] = label[b] = std::min(label[a], label[b]);
      changed = true;
    }
  }
  return label;
}

Links random_links(int num_bodies, int count, std::uint64_t seed) {
  Links links;
  for (int i = 0; i < count; ++i) {
    const auto pick = [&](std::uint64_t which) {
      return static_cast<int>(core::mix_key(seed, static_cast<std::uint64_t>(i), which) %
                              static_cast<std::uint64_t>(num_bodies + 1)) -
             1;  // -1 = no_body
    };
    links.emplace_back(pick(0), pick(1));
  }
  return links;
}

TEST(Islands, agree_with_brute_force_on_random_links) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const int num_bodies = 1 + static_cast<int>(core::mix64(seed) % 40);
    const Links links = random_links(num_bodies, static_cast<int>(seed % 50), seed);
    const Islands islands = find_islands(num_bodies, links);
    const std::vector<int> label = lowest_reachable(num_bodies, links);
    int num_labels = 0;
    for (int a = 0; a < num_bodies; ++a) {
      num_labels += label[a] == a ? 1 : 0;
      for (int b = 0; b < num_bodies; ++b) {
        ASSERT_EQ(islands.of_body[a] == islands.of_body[b], label[a] == label[b]) << "seed " << seed;
      }
    }
    ASSERT_EQ(islands.count, num_labels);
  }
}

TEST(Islands, are_numbered_by_their_lowest_body_whatever_the_order_of_links) {
  const Links links = {{4, 2}, {5, 0}, {3, 4}};
  const Links reversed = {{4, 3}, {0, 5}, {2, 4}};
  const std::vector<int> expected = {0, 1, 2, 2, 2, 0};
  EXPECT_EQ(find_islands(6, links).of_body, expected);
  EXPECT_EQ(find_islands(6, reversed).of_body, expected);
}

TEST(Islands, are_not_joined_through_the_world) {
  EXPECT_EQ(find_islands(2, Links{{0, no_body}, {no_body, 1}}).count, 2);
}

TEST(DisjointSets, are_represented_by_their_lowest_member) {
  DisjointSets sets(5);
  sets.unite(4, 3);
  sets.unite(3, 1);
  EXPECT_EQ(sets.find(4), 1);
  EXPECT_EQ(sets.find(0), 0);
  sets.reset(5);
  EXPECT_EQ(sets.find(4), 4);
}

}  // namespace
}  // namespace pbmpi::model
