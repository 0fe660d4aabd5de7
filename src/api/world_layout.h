/// What all worlds of a batch have in common: their bodies, motors and joints.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "analysis/joint_coordinates.h"
#include "pbmpi/batch.h"

namespace pbmpi::api {

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
