/// Broken joints as the rows see them: the lanes of their batch in which they exert nothing. (broken_joints.h
/// knows them by world; it is plain code, which is compiled once for all instruction sets.)
#pragma once

#include <cstddef>
#include <vector>

#include "solver/joints/joint_rows.h"

namespace pbmpi::solver {

template <class T>
class BrokenLanes {
 public:
  using V = typename T::V;

  /// Makes a joint of a shape's batches exert nothing in this lane from now on.
  void add(int shape, int joint, int lane) {
    for (BrokenJoint& broken : joints_) {
      if (broken.shape == shape && broken.joint == joint) return T::set(broken.holds, lane, 0);
    }
    BrokenJoint& broken = joints_.emplace_back();
    broken.holds = T::broadcast(1);
    broken.shape = shape;
    broken.joint = joint;
    T::set(broken.holds, lane, 0);
  }
  /// Calls visit(shape, joint, holds), with 1 in the lanes in which the joint is unbroken, else 0.
  template <class Visit>
  void for_each(Visit visit) const {
    for (const BrokenJoint& broken : joints_) visit(broken.shape, broken.joint, broken.holds);
  }

 private:
  struct alignas(sizeof(V)) BrokenJoint {
    V holds;
    int shape = 0, joint = 0;
  };
  std::vector<BrokenJoint> joints_;
};

/// Stops rows that have just been built where `holds` is 0: they start without an impulse, and without a
/// scale they keep none.
template <class T, model::JointKind kind>
PBMPI_LANES void stop_broken(JointRows<T, kind>& rows, const typename T::V& holds) {
  for (auto& row : rows.points) {
    row.scale = row.scale * holds;
    row.impulse = row.impulse * holds;
  }
  for_each_single_row(rows, [&](auto& row) {
    row.scale = row.scale * holds;
    row.impulse = row.impulse * holds;
  });
}

}  // namespace pbmpi::solver
