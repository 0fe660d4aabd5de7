#include "geometry/cell_grid.h"

#include <algorithm>

namespace pbmpi::geometry {

int CellGrid::level_of(const Box& box) {
  double side = 0;
  for (std::size_t k = 0; k < 3; ++k) side = std::max(side, box.max[k] - box.min[k]);
  int level = 0;
  std::frexp(side, &level);  // side <= 2^level
  return level;
}

void CellGrid::add(int item, int group, const Box& box) {
  for (std::size_t k = 0; k < 3; ++k) {
    if (!(box.min[k] > -farthest_m && box.max[k] < farthest_m)) return;
  }
  const int level = level_of(box);
  levels_.push_back(level);
  for_each_cell(box, level, [&](std::int64_t x, std::int64_t y, std::int64_t z) {
    entries_.push_back({key(group, level, x, y, z), item});
  });
}

void CellGrid::finish() {
  std::sort(levels_.begin(), levels_.end());
  levels_.erase(std::unique(levels_.begin(), levels_.end()), levels_.end());
  std::sort(entries_.begin(), entries_.end());
}

std::span<const CellGrid::Entry> CellGrid::cell_at(int group, int level, std::int64_t x, std::int64_t y,
                                                   std::int64_t z) const {
  const std::uint64_t wanted = key(group, level, x, y, z);
  const auto before = [](const Entry& entry, std::uint64_t cell) { return entry.cell < cell; };
  const auto first = std::lower_bound(entries_.begin(), entries_.end(), wanted, before);
  auto last = first;
  while (last != entries_.end() && last->cell == wanted) ++last;
  return {first, last};
}

}  // namespace pbmpi::geometry
