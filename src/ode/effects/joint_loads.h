/// What the joints of one ODE world exert on their bodies, for the effect "breakable_joints".
#pragma once

#include <span>
#include <vector>

#include "effects/breakage.h"
#include "model/step_memory.h"
#include "ode/objects/handles.h"

namespace pbmpi::ode {

/// ODE measures what a joint does to its bodies only if it has somewhere to write it (dJointSetFeedback).
class JointLoads {
 public:
  /// `model` is borrowed. `measured`: the joints that can break, or all, ascending.
  JointLoads(const model::Model& model, const std::vector<dJointID>& joints, std::span<const int> measured);

  /// Before the solver moves the bodies: where the torques are taken (effects::Reaction).
  void note_places();
  /// Force [N] on the first body of a measured joint, and torque [N m] about where note_places() was, world
  /// frame, in the step that was solved last. Limits and motors are part of both.
  model::JointForce force(int joint) const;
  /// In the step that was just solved, of a measured joint.
  effects::Reaction reaction(int joint) const;

 private:
  struct Measured {
    int joint = 0;
    model::Vec3 from_centre;  ///< from the first body's centre to where the torque is taken [m], world frame
    dJointFeedback feedback{};
  };

  const Measured& find(int joint) const;
  model::Vec3 place_from_centre(const model::Joint& joint, dJointID id) const;

  const model::Model* model_;
  std::vector<dJointID> joints_;
  std::vector<Measured> measured_;  ///< ODE keeps pointers to them
};

}  // namespace pbmpi::ode
