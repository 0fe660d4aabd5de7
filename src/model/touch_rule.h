/// Which geoms of a world may touch at all.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "model/model.h"

namespace pbmpi::model {

/// Two geoms may touch, except two static ones, two of one body, two of one actor without self_collision, two
/// of bodies that share a joint, and two planes. As with ODE's dAreConnectedExcluding a broken joint connects
/// nothing, and one unbroken joint of several is enough; an actor's self_collision still decides about its
/// own geoms.
class TouchRule {
 public:
  /// `model` is borrowed; `broken_in`: State::broken_in.
  explicit TouchRule(const Model& model, std::span<const std::int32_t> broken_in = {});

  /// Takes the indices of two geoms, in any order.
  bool may_touch(int first, int second) const;

 private:
  const Model* model_;
  std::vector<int> first_;   ///< [num_bodies + 1] where the bodies with an unbroken joint to it begin
  std::vector<int> joined_;  ///< these, sorted for each body
};

}  // namespace pbmpi::model
