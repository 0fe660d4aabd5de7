#include "solver/contact_colors.h"

#include <algorithm>
#include <bit>

#include "model/model.h"

namespace pbmpi::solver {

namespace {
constexpr int num_mask_colors = 64;
}

int ContactColors::paint(int num_bodies, std::span<const std::pair<int, int>> bodies,
                         std::vector<int>& colors) {
  used_.assign(static_cast<std::size_t>(num_bodies), 0);
  next_.assign(static_cast<std::size_t>(num_bodies), num_mask_colors);
  colors.resize(bodies.size());
  int count = 0;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const auto [a, b] = bodies[i];
    const unsigned long long taken =
        used_[static_cast<std::size_t>(a)] | (b == model::no_body ? 0 : used_[static_cast<std::size_t>(b)]);
    int color = std::countr_one(taken);
    if (color < num_mask_colors) {
      used_[static_cast<std::size_t>(a)] |= 1ull << color;
      if (b != model::no_body) used_[static_cast<std::size_t>(b)] |= 1ull << color;
    } else {  // a body with more than 64 contacts: its further ones come one after the other
      color = std::max(next_[static_cast<std::size_t>(a)],
                       b == model::no_body ? 0 : next_[static_cast<std::size_t>(b)]);
      next_[static_cast<std::size_t>(a)] = color + 1;
      if (b != model::no_body) next_[static_cast<std::size_t>(b)] = color + 1;
    }
    colors[i] = color;
    count = std::max(count, color + 1);
  }
  return count;
}

}  // namespace pbmpi::solver
