#include "solver/worlds/group_plan.h"

#include <algorithm>
#include <cmath>

#include "solver/layout/cells.h"

namespace pbmpi::solver {
namespace {

constexpr int bytes_a_number(stepping::Precision precision) {
  return precision == stepping::Precision::single ? 4 : 8;
}

}  // namespace

GroupPlan::GroupPlan(int num_worlds, int num_packs, int num_lanes)
    : num_worlds_(num_worlds),
      num_lanes_(num_lanes),
      num_batches_((num_worlds + num_lanes - 1) / num_lanes),
      num_packs_(std::clamp(num_packs, 1, std::max(1, num_batches_))) {}

std::vector<int> GroupPlan::sizes() const {
  std::vector<int> sizes;
  int dealt = 0;
  for (int pack = 1; pack <= num_packs_; ++pack) {
    const auto batches =
        static_cast<int>(static_cast<std::int64_t>(num_batches_) * pack / num_packs_);  // up to this pack
    sizes.push_back(std::min(batches * num_lanes_, num_worlds_) - dealt);
    dealt += sizes.back();
  }
  return sizes;
}

bool GroupPlan::contains(int size) const {
  const int fewest = num_batches_ / num_packs_;
  const int most = fewest + (num_batches_ % num_packs_ > 0 ? 1 : 0);
  return size % num_lanes_ == 0 && size / num_lanes_ >= fewest && size / num_lanes_ <= most;
}

int packs_for(std::int64_t num_bodies, double share, stepping::Precision precision, int num_threads) {
  const int most_bodies = bodies_in_cache(bytes_a_number(precision));
  const auto for_cache = std::max<std::int64_t>(1, (num_bodies + most_bodies / 2) / most_bodies);
  const auto for_threads = std::max<std::int64_t>(1, std::llround(std::ceil(share * num_threads)));
  return static_cast<int>((for_cache + for_threads - 1) / for_threads * for_threads);
}

}  // namespace pbmpi::solver
