/// Which geoms of a world may touch at all.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "model/model.h"

namespace pbmpi::model {

/// Two geoms may touch, but not two static ones, not two of one body, not two of one actor without
/// self_collision, not two of bodies that share a joint, not two planes. As with ODE's dAreConnectedExcluding
/// a joint that is broken connects nothing, and one of several that holds is enough; an actor's
/// self_collision still decides about its own geoms.
class TouchRule {
 public:
  /// `model` is borrowed; `broken_in`: as in State.
  explicit TouchRule(const Model& model, std::span<const std::int32_t> broken_in = {});

  /// Geoms by their index, in any order.
  bool may_touch(int first, int second) const;

 private:
  const Model* model_;
  std::vector<std::vector<int>> joined_;  ///< [num_bodies] bodies with a joint to it that holds, sorted
};

}  // namespace pbmpi::model
