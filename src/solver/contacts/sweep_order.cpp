#include "solver/contacts/sweep_order.h"

#include <algorithm>
#include <numeric>

#include "core/random.h"

namespace pbmpi::solver {

void SweepOrder::sort(int num_colors) {
  colors_.resize(static_cast<std::size_t>(num_colors));
  std::iota(colors_.begin(), colors_.end(), 0);
  std::iota(points_.begin(), points_.end(), 0);
}

void SweepOrder::shuffle(int num_colors, std::uint64_t key) {
  sort(num_colors);
  const auto by_key = [key](std::uint64_t which) {
    return [key, which](int number) { return core::mix_key(key, static_cast<std::uint64_t>(number), which); };
  };
  std::ranges::sort(colors_, {}, by_key(0));
  std::ranges::sort(points_, {}, by_key(1));
}

}  // namespace pbmpi::solver
