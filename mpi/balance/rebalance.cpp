#include "mpi/balance/rebalance.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <set>
#include <utility>

#include "core/error.h"

namespace pbmpi::mpi {
namespace {

double mean_load(const std::vector<double>& loads) {
  return std::accumulate(loads.begin(), loads.end(), 0.0) / static_cast<double>(loads.size());
}

/// A world that leaves the most loaded rank, and perhaps one that comes back for it.
struct Exchange {
  int out = -1;
  int back = -1;  ///< the world that comes back; -1 for none
  int to = 0;
};

/// A placement under improvement, with its loads.
class Balancer {
 public:
  Balancer(std::span<const int> placement, std::span<const double> cost, int num_ranks)
      : placement_(placement.begin(), placement.end()),
        cost_(cost),
        loads_(rank_loads(placement, cost, num_ranks)),
        mean_(mean_load(loads_)),
        worlds_(num_ranks) {
    for (std::size_t world = 0; world < placement.size(); ++world) {
      worlds_[placement[world]].push_back(static_cast<int>(world));
    }
    for (int rank = 0; rank < num_ranks; ++rank) by_load_.emplace(loads_[rank], rank);
  }

  const Placement& placement() const { return placement_; }
  double makespan() const { return by_load_.rbegin()->first; }
  double imbalance_now() const { return mean_ > 0 ? makespan() / mean_ : 1.0; }

  /// Takes load off the most loaded rank. False if no move and no swap achieves that.
  bool improve() {
    const int from = by_load_.lower_bound({makespan(), -1})->second;  // the lowest rank with that load
    std::optional<Exchange> exchange = best_move(from);
    for (const auto& [load, to] : by_load_) {
      if (exchange) break;
      if (to != from) exchange = best_swap(from, to);
    }
    if (!exchange) return false;
    apply(from, *exchange);
    return true;
  }

 private:
  /// True if passing `amount` across the gap between two ranks leaves both below the higher one. Gains
  /// within rounding error count as none; otherwise worlds of equal cost could be passed on for ever.
  static bool gains(double amount, double gap) { return amount > 1e-9 * gap && amount < gap * (1 - 1e-9); }

  /// The world of `from` whose move to the least loaded rank leaves the two most alike.
  std::optional<Exchange> best_move(int from) const {
    const int to = by_load_.begin()->second;
    const double gap = loads_[from] - loads_[to];
    std::optional<Exchange> best;
    double best_distance = gap;
    for (const int world : worlds_[from]) {
      const double distance = std::abs(cost_[world] - gap / 2);
      if (!gains(cost_[world], gap) || distance >= best_distance) continue;
      best = Exchange{world, -1, to};
      best_distance = distance;
    }
    return best;
  }

  /// The two worlds of `from` and `to` whose swap leaves the two ranks most alike.
  std::optional<Exchange> best_swap(int from, int to) const {
    const double gap = loads_[from] - loads_[to];
    std::vector<int> others = worlds_[to];
    std::stable_sort(others.begin(), others.end(), [&](int a, int b) { return cost_[a] < cost_[b]; });
    std::optional<Exchange> best;
    double best_distance = gap;
    for (const int world : worlds_[from]) {
      // The best partner's cost is the closest to cost - gap / 2: one of the two around that value.
      const auto above = std::lower_bound(others.begin(), others.end(), cost_[world] - gap / 2,
                                          [&](int other, double value) { return cost_[other] < value; });
      const auto first = above == others.begin() ? above : above - 1;
      const auto last = above == others.end() ? above : above + 1;
      for (auto other = first; other != last; ++other) {
        const double amount = cost_[world] - cost_[*other];
        const double distance = std::abs(amount - gap / 2);
        if (!gains(amount, gap) || distance >= best_distance) continue;
        best = Exchange{world, *other, to};
        best_distance = distance;
      }
    }
    return best;
  }

  void apply(int from, const Exchange& exchange) {
    pass(exchange.out, from, exchange.to);
    if (exchange.back >= 0) pass(exchange.back, exchange.to, from);
    for (const int rank : {from, exchange.to}) {
      by_load_.erase({loads_[rank], rank});
      loads_[rank] = 0;  // summed anew, in order, which leaves no rounding errors of earlier moves
      for (const int world : worlds_[rank]) loads_[rank] += cost_[world];
      by_load_.emplace(loads_[rank], rank);
    }
  }

  void pass(int world, int from, int to) {
    std::erase(worlds_[from], world);
    auto& worlds = worlds_[to];
    worlds.insert(std::lower_bound(worlds.begin(), worlds.end(), world), world);
    placement_[world] = to;
  }

  Placement placement_;
  std::span<const double> cost_;
  std::vector<double> loads_;                 ///< [num_ranks]
  std::set<std::pair<double, int>> by_load_;  ///< (load, rank): a round must not look at every rank
  double mean_;                               ///< mean of the loads, which no exchange changes
  std::vector<std::vector<int>> worlds_;      ///< [num_ranks] ascending
};

}  // namespace

Rebalancing Rebalancer::frame_done(std::span<const double> cost_s, std::span<const int> placement) {
  if (recent_.size() < window) {
    recent_.emplace_back(cost_s.begin(), cost_s.end());
  } else {
    std::copy(cost_s.begin(), cost_s.end(), recent_[next_slot_].begin());
    next_slot_ = (next_slot_ + 1) % window;
  }
  frames_until_decision_ = std::max(0, frames_until_decision_ - 1);
  if (frames_until_decision_ > 0) return {};
  Rebalancing found = rebalance(placement, smoothed(), num_ranks_, threshold_);
  if (!found.moves.empty()) frames_until_decision_ = cooldown + 1;
  return found;
}

std::vector<double> Rebalancer::smoothed() const {
  if (recent_.empty()) return {};
  std::vector<double> median = recent_[0];
  static_assert(window == 3);
  for (std::size_t world = 0; world < median.size() && recent_.size() > 1; ++world) {
    const auto [low, high] = std::minmax({recent_[0][world], recent_[1][world]});
    // With two frames the cheaper one counts: noise only adds time.
    median[world] = recent_.size() == 2 ? low : std::clamp(recent_[2][world], low, high);
  }
  return median;
}

Rebalancing rebalance(std::span<const int> placement, std::span<const double> cost, int num_ranks,
                      double threshold) {
  core::require_invariant(threshold >= 1, "rebalance: threshold >= 1");
  const auto valid = [](double c) { return std::isfinite(c) && c >= 0; };
  core::require_invariant(std::all_of(cost.begin(), cost.end(), valid),
                          "rebalance: costs are finite and not negative");

  Balancer balancer(placement, cost, num_ranks);
  Rebalancing result;
  result.imbalance_before = result.imbalance_after = balancer.imbalance_now();
  if (result.imbalance_before <= threshold) return result;

  const double tolerated_half = (threshold - 1) / 2;
  const double makespan_before = balancer.makespan();
  // Each round lowers the load of the most loaded rank, so this ends; the bound only caps the time that a
  // decision may take.
  for (std::size_t round = 0; round < 2 * cost.size() && balancer.imbalance_now() > 1 + tolerated_half;
       ++round) {
    if (!balancer.improve()) break;
  }
  const double gain = 1 - balancer.makespan() / makespan_before;
  if (gain <= 0 || gain < tolerated_half) return result;

  for (std::size_t world = 0; world < placement.size(); ++world) {
    const int to = balancer.placement()[world];
    if (to != placement[world]) result.moves.push_back({static_cast<int>(world), to});
  }
  result.imbalance_after = balancer.imbalance_now();
  return result;
}

}  // namespace pbmpi::mpi
