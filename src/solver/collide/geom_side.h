/// One side of the pairs in the lanes.
#pragma once

#include "solver/collide/geom_lanes.h"
#include "solver/collide/pair_table.h"

namespace pbmpi::solver {

/// One geom of each lane's pair.
template <class T>
struct GeomSide {
  using V = typename T::V;
  using L3 = Vec3L<V>;

  const GeomLanes<T>* geoms;
  const std::int32_t* index;  ///< [num_lanes]

  PBMPI_LANES L3 centre() const {
    return {geoms->position[0].gather(index), geoms->position[1].gather(index),
            geoms->position[2].gather(index)};
  }
  /// The geom's own axis k in the world frame.
  PBMPI_LANES L3 axis(int k) const {
    return {geoms->rotation[k].gather(index), geoms->rotation[3 + k].gather(index),
            geoms->rotation[6 + k].gather(index)};
  }
  PBMPI_LANES V half(int k) const { return geoms->half[k].gather(index); }
  PBMPI_LANES V radius() const { return geoms->radius.gather(index); }
};

}  // namespace pbmpi::solver
