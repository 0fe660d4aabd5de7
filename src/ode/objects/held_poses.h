/// Motors that hold the initial pose: aimed anew in each step.
#pragma once

#include <vector>

#include "model/model.h"
#include "ode/objects/handles.h"

namespace pbmpi::ode {

/// The motors of a world that have a hold rate. ODE's motors know only a velocity, which here follows from
/// the coordinate of the axis.
class HeldPoses {
 public:
  /// Holds what the model's motors hold. `model` is borrowed.
  HeldPoses(const model::Model& model, const std::vector<dJointID>& joints);

  /// From now on this motor drives the axis; without a hold rate it is no longer aimed.
  void replace(int joint, int axis, const model::AxisMotor& motor);
  /// Aims all of them for a step of `dt_s` from the present poses.
  void aim(double dt_s) const;

 private:
  struct Held {
    int joint, axis;
    model::AxisMotor motor;
  };

  const model::Model* model_;
  std::vector<dJointID> joints_;
  std::vector<Held> held_;
};

}  // namespace pbmpi::ode
