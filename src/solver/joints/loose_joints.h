/// Joints that have broken in some lanes of their batch: there their rows push nothing.
#pragma once

#include <cstddef>
#include <vector>

#include "solver/joints/joint_rows.h"

namespace pbmpi::solver {

template <class T>
class LooseJoints {
 public:
  using V = typename T::V;

  /// A joint of a shape's batches that acts no more in this lane.
  void add(int shape, int joint, int lane) {
    for (Loose& loose : loose_) {
      if (loose.shape == shape && loose.joint == joint) return T::set(loose.holds, lane, 0);
    }
    Loose& loose = loose_.emplace_back();
    loose.holds = T::broadcast(1);
    loose.shape = shape;
    loose.joint = joint;
    T::set(loose.holds, lane, 0);
  }
  /// visit(shape, joint, holds) with 1 in the lanes that hold.
  template <class Visit>
  void for_each(Visit visit) const {
    for (const Loose& loose : loose_) visit(loose.shape, loose.joint, loose.holds);
  }

 private:
  struct alignas(sizeof(V)) Loose {
    V holds;
    int shape = 0, joint = 0;
  };
  std::vector<Loose> loose_;
};

/// Of rows just built. An impulse starts at 0 in a step, so that without a scale it stays there.
template <class T, model::JointKind kind>
PBMPI_LANES void loosen(JointRows<T, kind>& rows, const typename T::V& holds) {
  for (auto& row : rows.points) row.scale = row.scale * holds;
  for_each_single_row(rows, [&](auto& row) { row.scale = row.scale * holds; });
}

}  // namespace pbmpi::solver
