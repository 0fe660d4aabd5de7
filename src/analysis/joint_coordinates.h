/// Where the axes of joints stand.
#pragma once

#include <span>
#include <vector>

#include "model/model.h"
#include "model/state.h"

namespace pbmpi::analysis {

/// An axis of a joint.
struct JointAxis {
  int joint = 0, axis = 0;  ///< axis: 0 or 1, for axis 1 or 2

  bool operator==(const JointAxis&) const = default;
};

/// The axes of all joints, in the order of joints.
std::vector<JointAxis> axes_of(const model::Model& model);

/// Measures the states of one model.
class JointCoordinates {
 public:
  explicit JointCoordinates(const model::Model& model);

  std::span<const JointAxis> axes() const { return axes_; }
  /// [rad] by which the first body has turned against the second about each axis, or [m] by which it has
  /// moved along it, since the model's initial poses. Angles lie within half a turn, except where the state
  /// counts turns (model::JointForce::angle). `coordinates`: [num_axes].
  void measure(const model::State& state, std::span<double> coordinates) const;

 private:
  /// An axis in the frame of the body in which it is fixed, and what is seen to turn about it.
  struct Seen {
    int from = 0, to = model::no_body;  ///< the body with the axis, and the other
    double sign = 1;                    ///< -1 where the other one is the joint's second body
    model::Vec3 axis, normal;           ///< in the frame of `from`; at the start `mark` lies along the normal
    model::Vec3 mark;                   ///< in the frame of `to`
    bool slides = false;
    double start = 0;  ///< [m] where a slider starts
  };
  static double angle(const Seen& seen, const model::State& state);
  static double length(const Seen& seen, const model::State& state);

  std::vector<JointAxis> axes_;
  std::vector<Seen> seen_;  ///< [num_axes]
};

/// The direction of an axis in a state, unit, world frame.
model::Vec3 axis_direction(const model::State& state, const model::Joint& joint, int axis);

}  // namespace pbmpi::analysis
