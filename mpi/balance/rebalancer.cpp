#include "mpi/balance/rebalancer.h"

#include <algorithm>

namespace pbmpi::mpi {

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

}  // namespace pbmpi::mpi
