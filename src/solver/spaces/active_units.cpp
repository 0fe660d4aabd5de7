#include "solver/spaces/active_units.h"

#include <algorithm>

namespace pbmpi::solver {

void ActiveUnits::clear() {
  units_.clear();
  bodies_.clear();
}

bool ActiveUnits::set(std::span<const int> units, const effects::SpaceSleepers* sleepers,
                      bool may_sleep_in_part) {
  const auto is_awake = [&](int body) { return sleepers == nullptr || !sleepers->asleep(body); };
  std::vector<int> awake;
  for (const int unit : units) {
    const std::vector<int>& bodies = map_->bodies_of_unit[static_cast<std::size_t>(unit)];
    if (std::any_of(bodies.begin(), bodies.end(), is_awake)) awake.push_back(unit);
  }
  if (awake == units_ && !may_sleep_in_part) return false;
  units_ = std::move(awake);
  bodies_.clear();
  for (const int unit : units_) {
    for (const int body : map_->bodies_of_unit[static_cast<std::size_t>(unit)]) {
      if (is_awake(body)) bodies_.push_back(body);
    }
  }
  return true;
}

bool ActiveUnits::contains(int unit) const { return std::binary_search(units_.begin(), units_.end(), unit); }

}  // namespace pbmpi::solver
