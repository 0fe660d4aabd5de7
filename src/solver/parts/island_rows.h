/// Counts the rows of the islands of a world.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "model/islands.h"
#include "stepping/observables.h"

namespace pbmpi::solver {

/// Joins bodies into islands and counts their rows. Keeps its memory from step to step.
class IslandRows {
 public:
  /// Starts anew with bodies that have no links and no rows.
  void reset(int num_bodies);
  /// Puts the bodies into one island; no_body as `b` joins nothing.
  void join(int a, int b) {
    if (b != model::no_body) sets_.unite(a, b);
  }
  /// Adds rows whose first body is `body`.
  void add(int body, int rows) { rows_[static_cast<std::size_t>(body)] += rows; }
  /// Sets rows, max_island_rows and row_visits from the rows of these bodies, and islands to the number of
  /// islands whose lowest body is among them. sweeps(body): how many sweeps the rows of a body got.
  template <class Sweeps>
  void count(std::span<const int> bodies, Sweeps sweeps, stepping::Observables& counts);

 private:
  model::DisjointSets sets_{0};
  std::vector<int> rows_;         ///< [num_bodies]
  std::vector<int> island_rows_;  ///< [num_bodies] rows of an island at its lowest body; scratch of count()
};

template <class Sweeps>
void IslandRows::count(std::span<const int> bodies, Sweeps sweeps, stepping::Observables& counts) {
  counts.rows = counts.islands = counts.max_island_rows = 0;
  counts.row_visits = 0;
  island_rows_.assign(rows_.size(), 0);
  for (const int body : bodies) {
    const int rows = rows_[static_cast<std::size_t>(body)];
    const int lowest = sets_.find(body);
    if (lowest == body) ++counts.islands;
    if (rows == 0) continue;
    int& island_rows = island_rows_[static_cast<std::size_t>(lowest)];
    island_rows += rows;
    counts.max_island_rows = std::max(counts.max_island_rows, island_rows);
    counts.rows += rows;
    counts.row_visits += static_cast<double>(rows) * sweeps(body);
  }
}

}  // namespace pbmpi::solver
