/// Motors that hold the initial pose: their targets are set anew in each step.
#pragma once

#include <vector>

#include "model/model.h"
#include "ode/objects/handles.h"

namespace pbmpi::ode {

/// The motors of a world that have a hold rate. ODE's motors know only a velocity, which is computed here
/// from the coordinate of the axis.
class HeldPoses {
 public:
  /// Takes over the motors of the model that hold a pose. `model` is borrowed.
  HeldPoses(const model::Model& model, const std::vector<dJointID>& joints);

  /// Makes this motor drive the axis from now on; without a hold rate its target is no longer updated.
  void replace(int joint, int axis, const model::AxisMotor& motor);
  /// Sets the targets of all of them for a step of `dt_s` from the present poses.
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
