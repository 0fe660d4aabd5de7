#include "solver/may_touch_table.h"

#include "model/touch_rule.h"

namespace pbmpi::solver {

MayTouchTable::MayTouchTable(const model::Model& model)
    : words_a_row_(model.geoms.size() / 32 + 1), words_(model.geoms.size() * words_a_row_, 0) {
  const model::TouchRule rule(model);
  const int count = static_cast<int>(model.geoms.size());
  const auto is_plane = [&](int geom) {
    return model.geoms[static_cast<std::size_t>(geom)].shape == model::Shape::plane;
  };
  for (int row = 0; row < count; ++row) {
    for (int other = is_plane(row) ? 0 : row + 1; other < count; ++other) {
      if (is_plane(other) || !rule.may_touch(row, other)) continue;
      words_[static_cast<std::size_t>(row) * words_a_row_ + static_cast<std::size_t>(other / 32)] |=
          1u << (other % 32);
    }
  }
}

}  // namespace pbmpi::solver
