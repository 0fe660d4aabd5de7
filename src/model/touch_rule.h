/// Which geoms of a world may touch at all.
#pragma once

#include <vector>

#include "model/model.h"

namespace pbmpi::model {

/// Not two static geoms, not two of one body, not two of one actor without self_collision, not two of bodies
/// that share a joint, not two planes.
class TouchRule {
 public:
  /// `model` is borrowed.
  explicit TouchRule(const Model& model);

  /// Geoms by their index, in any order.
  bool may_touch(int first, int second) const;

 private:
  const Model* model_;
  std::vector<std::vector<int>> joined_;  ///< [num_bodies] bodies with a joint to it, sorted
};

}  // namespace pbmpi::model
