/// Motors that hold the initial pose: aimed anew in each step.
#pragma once

#include <vector>

#include "bullet/objects/axis_joints.h"

namespace pbmpi::bullet {

/// The motors of a world that have a hold rate: the velocity at which Bullet's motor aims follows from the
/// coordinate of the axis.
class HeldPoses {
 public:
  /// Holds what the model's motors hold. `joints` are borrowed.
  HeldPoses(const model::Model& model, AxisJoints& joints);

  /// From now on this motor drives the axis; without a hold rate it is no longer aimed.
  void replace(int joint, int axis, const model::AxisMotor& motor);
  /// Aims all of them for a step of `dt_s` from the present poses.
  void aim(double dt_s) const;

 private:
  struct Held {
    int joint, axis;
    model::AxisMotor motor;
  };

  AxisJoints* joints_;
  std::vector<Held> held_;
};

}  // namespace pbmpi::bullet
