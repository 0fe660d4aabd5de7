/// Bits that say which of a world's geoms may touch, in rows that fit chunks of lanes.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "model/model.h"

namespace pbmpi::solver {

class MayTouchTable {
 public:
  /// Rows and bits count along `geoms`; `broken_in`: State::broken_in.
  MayTouchTable(const model::Model& model, std::span<const int> geoms,
                std::span<const std::int32_t> broken_in = {});

  /// Bit b: may geom `row` touch geom first + b? For a solid row only solids after it, so that each pair
  /// appears once; for a plane all solids. `first` is a multiple of 16, or of a power of two below.
  std::uint32_t bits(int row, int first) const {
    const auto at = static_cast<unsigned>(first);
    return words_[static_cast<std::size_t>(row) * words_a_row_ + at / 32] >> (at % 32);
  }

  bool is_plane(int row) const { return planes_[static_cast<std::size_t>(row)] != 0; }

 private:
  std::size_t words_a_row_;
  std::vector<char> planes_;  ///< [rows]
  std::vector<std::uint32_t> words_;
};

}  // namespace pbmpi::solver
