#include "solver/collide/may_touch_table.h"

#include "model/touch_rule.h"

namespace pbmpi::solver {

MayTouchTable::MayTouchTable(const model::Model& model, std::span<const int> geoms,
                             std::span<const std::int32_t> broken_in)
    : words_a_row_(geoms.size() / 32 + 1), words_(geoms.size() * words_a_row_, 0) {
  const model::TouchRule rule(model, broken_in);
  const int count = static_cast<int>(geoms.size());
  const auto geom = [&](int i) { return geoms[static_cast<std::size_t>(i)]; };
  for (const int index : geoms)
    planes_.push_back(model.geoms[static_cast<std::size_t>(index)].shape == model::Shape::plane ? 1 : 0);
  for (int row = 0; row < count; ++row) {
    for (int other = is_plane(row) ? 0 : row + 1; other < count; ++other) {
      if (is_plane(other) || !rule.may_touch(geom(row), geom(other))) continue;
      words_[static_cast<std::size_t>(row) * words_a_row_ + static_cast<std::size_t>(other / 32)] |=
          1u << (other % 32);
    }
  }
}

}  // namespace pbmpi::solver
