#include "mpi/balance/partition.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <queue>
#include <utility>

#include "core/error.h"

namespace pbmpi::mpi {
namespace {

void require_costs(std::span<const double> cost) {
  const auto valid = [](double c) { return std::isfinite(c) && c >= 0; };
  core::require_invariant(std::all_of(cost.begin(), cost.end(), valid), "costs are finite and not negative");
}

double average(std::span<const double> loads) {
  return std::accumulate(loads.begin(), loads.end(), 0.0) / static_cast<double>(loads.size());
}

}  // namespace

Placement equal_placement(int num_worlds, int num_ranks) {
  core::require_invariant(num_worlds >= 0 && num_ranks >= 1,
                          "equal_placement: num_worlds >= 0, num_ranks >= 1");
  Placement placement;
  placement.reserve(num_worlds);
  for (int rank = 0; rank < num_ranks; ++rank) {
    const int count = num_worlds / num_ranks + (rank < num_worlds % num_ranks ? 1 : 0);
    placement.insert(placement.end(), count, rank);
  }
  return placement;
}

Placement lpt_placement(std::span<const double> cost, int num_ranks) {
  core::require_invariant(num_ranks >= 1, "lpt_placement: num_ranks >= 1");
  require_costs(cost);
  std::vector<int> order(cost.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return cost[a] > cost[b]; });

  using Load = std::pair<double, int>;  // (load, rank): the least loaded, then the lowest rank on top
  std::priority_queue<Load, std::vector<Load>, std::greater<>> ranks;
  for (int rank = 0; rank < num_ranks; ++rank) ranks.emplace(0.0, rank);
  Placement placement(cost.size());
  for (const int world : order) {
    const auto [load, rank] = ranks.top();
    ranks.pop();
    placement[world] = rank;
    ranks.emplace(load + cost[world], rank);
  }
  return placement;
}

std::vector<double> rank_loads(std::span<const int> placement, std::span<const double> cost, int num_ranks) {
  core::require_invariant(placement.size() == cost.size(), "rank_loads: one cost a world");
  std::vector<double> loads(num_ranks, 0.0);
  for (std::size_t world = 0; world < cost.size(); ++world) loads.at(placement[world]) += cost[world];
  return loads;
}

double imbalance(std::span<const double> loads) {
  const double mean = average(loads);
  return mean > 0 ? *std::max_element(loads.begin(), loads.end()) / mean : 1.0;
}

}  // namespace pbmpi::mpi
