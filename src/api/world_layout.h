/// What all worlds of a batch have in common: their bodies, motors and joints.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "analysis/joint_coordinates.h"
#include "model/state.h"
#include "pbmpi/batch.h"

namespace pbmpi::api {

/// Arrays for `num_worlds` worlds of `num_bodies` bodies each.
BatchState make_arrays(int num_worlds, int num_bodies);

/// Throws core::InputError, saying which array is how long, unless `arrays` are as long as make_arrays()'s.
void require_shape(const BatchState& arrays, int num_worlds, int num_bodies);

/// Writes a state to world `index` of the arrays.
void put(const model::State& state, int index, BatchState& arrays);

/// Reads poses and velocities from world `index` of the arrays; the rest of `state` stays. Throws
/// core::InputError, naming world `id` and the body, for a number that is not finite, and an orientation
/// whose length is not 1.
void take(const BatchState& arrays, int index, int id, const model::Model& model, model::State& state);

class WorldLayout {
 public:
  /// The layout of `model` and of all worlds like it.
  explicit WorldLayout(const model::Model& model);

  int num_bodies() const { return static_cast<int>(body_names_.size()); }
  int num_motors() const { return static_cast<int>(motors_.size()); }
  std::span<const std::string> body_names() const { return body_names_; }
  std::span<const Motor> motors() const { return motors_; }
  /// [num_motors] the axis that each motor drives.
  std::span<const analysis::JointAxis> axes() const { return axes_; }
  std::span<const JointAxis> joint_axes() const { return joint_axes_; }

  /// Throws core::InputError, naming the world and what differs, unless it has the same bodies, motors and
  /// joints.
  void require_same(int world, const model::Model& model) const;

 private:
  std::vector<std::string> body_names_;
  std::vector<Motor> motors_;
  std::vector<analysis::JointAxis> axes_;
  std::vector<JointAxis> joint_axes_;
};

}  // namespace pbmpi::api
