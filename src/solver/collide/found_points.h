/// What the kernels of the narrow phase find.
#pragma once

#include "solver/collide/geom_lanes.h"
#include "solver/collide/pair_table.h"

namespace pbmpi::solver {

/// A point of each lane's pair, where the flag `touching` is not 0.
template <class V>
struct alignas(sizeof(V)) FoundPoint {
  V touching;
  Vec3L<V> position, normal;
  V depth;
};

/// What a kernel found.
template <class V>
struct alignas(sizeof(V)) Found {
  FoundPoint<V> points[Touch::most_points];
  int num_points = 0;  ///< the most that this kind of pair can have
};

/// 1 in the lanes in which a comparison holds, else 0.
template <class T>
PBMPI_LANES typename T::V flag(auto mask) {
  return mask ? T::broadcast(1) : T::broadcast(0);
}

}  // namespace pbmpi::solver
