/// The loads that the joints of one ODE world exert on their bodies, for the effect "breakable_joints".
#pragma once

#include <span>
#include <vector>

#include "effects/breakage.h"
#include "model/step_memory.h"
#include "ode/objects/handles.h"

namespace pbmpi::ode {

/// ODE measures a joint's force on its bodies only if it is given memory for it (dJointSetFeedback).
class JointLoads {
 public:
  /// `model` is borrowed. `measured`: the joints that can break, or all, ascending.
  JointLoads(const model::Model& model, const std::vector<dJointID>& joints, std::span<const int> measured);

  /// Called before the solver moves the bodies: stores the points about which torques are taken
  /// (effects::Reaction).
  void note_places();
  /// Force [N] on the first body of a measured joint, and torque [N m] about the point of note_places(),
  /// world frame, in the step that was solved last. Both include limits and motors.
  model::JointForce force(int joint) const;
  /// The reaction of a measured joint in the step that was just solved.
  effects::Reaction reaction(int joint) const;

 private:
  struct Measured {
    int joint = 0;
    model::Vec3 from_centre;  ///< from the first body's centre to the point of the torque [m], world frame
    dJointFeedback feedback{};
  };

  const Measured& find(int joint) const;
  model::Vec3 place_from_centre(const model::Joint& joint, dJointID id) const;

  const model::Model* model_;
  std::vector<dJointID> joints_;
  std::vector<Measured> measured_;  ///< ODE keeps pointers to these
};

}  // namespace pbmpi::ode
