/// Where the geoms of a pack's worlds lie in its columns.
#pragma once

#include <span>
#include <vector>

#include "solver/layout/packed_world.h"

namespace pbmpi::solver {

/// World by world, each at the beginning of a cache line; within a world the swept geoms come first,
/// ascending, and the others after them.
class GeomOrder {
 public:
  explicit GeomOrder(std::span<const PackedWorld> worlds);

  int num_columns() const { return static_cast<int>(geom_of_column_.size()); }
  int column(int world, int geom) const {
    return column_of_geom_[static_cast<std::size_t>(first(world) + geom)];
  }
  /// Column of a world's first geom.
  int first(int world) const { return first_[static_cast<std::size_t>(world)]; }
  /// The swept geoms of a world, ascending, by their indices in its model.
  std::span<const int> swept(int world) const {
    return std::span(geom_of_column_)
        .subspan(static_cast<std::size_t>(first(world)),
                 static_cast<std::size_t>(num_swept_[static_cast<std::size_t>(world)]));
  }

  /// Which chunks of `num_lanes` columns hold the swept geoms of all worlds, ascending.
  std::vector<int> swept_chunks(int num_lanes) const;
  /// Which chunks hold the geoms of these pairs of a world, ascending.
  void find_chunks(int world, std::span<const model::GeomPair> pairs, int num_lanes,
                   std::vector<int>& chunks) const;

 private:
  std::vector<int> first_, num_swept_;  ///< [worlds]
  std::vector<int> geom_of_column_, column_of_geom_;
};

}  // namespace pbmpi::solver
