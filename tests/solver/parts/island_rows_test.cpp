#include "solver/parts/island_rows.h"

#include <gtest/gtest.h>

#include <map>
#include <numeric>

#include "core/random.h"

namespace pbmpi::solver {
namespace {

using model::no_body;

struct Link {
  int a = 0, b = no_body;
  int rows = 0;
};

std::vector<Link> random_links(int num_bodies, std::uint64_t seed) {
  std::vector<Link> links(seed % 50);
  for (std::size_t i = 0; i < links.size(); ++i) {
    const auto below = [&](std::uint64_t which, int count) {
      return static_cast<int>(core::mix_key(seed, i, which) % static_cast<std::uint64_t>(count));
    };
    links[i] = {below(0, num_bodies), below(1, num_bodies + 1) - 1, below(2, 4)};
  }
  return links;
}

int sweeps_of(int body) { return 1 + body % 3; }

/// Counts link by link, over the islands of model::find_islands().
stepping::Observables counted_by_links(int num_bodies, const std::vector<Link>& links) {
  std::vector<std::pair<int, int>> pairs;
  for (const Link& link : links) pairs.emplace_back(link.a, link.b);
  const model::Islands islands = model::find_islands(num_bodies, pairs);
  stepping::Observables counts;
  counts.islands = islands.count;
  std::map<int, int> rows_of_island;
  for (const Link& link : links) {
    counts.rows += link.rows;
    counts.row_visits += static_cast<double>(link.rows) * sweeps_of(link.a);
    int& rows = rows_of_island[islands.of_body[static_cast<std::size_t>(link.a)]];
    rows += link.rows;
    counts.max_island_rows = std::max(counts.max_island_rows, rows);
  }
  return counts;
}

TEST(IslandRows, are_those_of_the_islands_found_link_by_link) {
  IslandRows island_rows;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const int num_bodies = 1 + static_cast<int>(core::mix64(seed) % 40);
    const std::vector<Link> links = random_links(num_bodies, seed);
    island_rows.reset(num_bodies);
    for (const Link& link : links) {
      island_rows.join(link.a, link.b);
      island_rows.add(link.a, link.rows);
    }
    std::vector<int> bodies(static_cast<std::size_t>(num_bodies));
    std::iota(bodies.begin(), bodies.end(), 0);
    stepping::Observables counts;
    island_rows.count(bodies, sweeps_of, counts);
    const stepping::Observables expected = counted_by_links(num_bodies, links);
    ASSERT_EQ(counts.islands, expected.islands) << "seed " << seed;
    ASSERT_EQ(counts.rows, expected.rows) << "seed " << seed;
    ASSERT_EQ(counts.max_island_rows, expected.max_island_rows) << "seed " << seed;
    ASSERT_EQ(counts.row_visits, expected.row_visits) << "seed " << seed;
  }
}

}  // namespace
}  // namespace pbmpi::solver
