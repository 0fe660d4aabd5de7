/// The loads that the joints of one world exert on their bodies.
#pragma once

#include <span>
#include <vector>

#include "bullet/objects/axis_joints.h"
#include "effects/breakage.h"
#include "model/step_memory.h"

namespace pbmpi::bullet {

/// Bullet measures a joint's force on its bodies only if it is given memory for it.
class JointLoads {
 public:
  /// `model` and `bodies` are borrowed. `measured`: the joints that can break, or all, ascending.
  JointLoads(const model::Model& model, const Bodies& bodies, AxisJoints& joints,
             std::span<const int> measured);
  JointLoads(const JointLoads&) = delete;
  JointLoads& operator=(const JointLoads&) = delete;

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
    model::Vec3 from_centre = model::Vec3::Zero();  ///< [m] world frame, from the first body's centre of mass
    btJointFeedback feedback{};
  };

  const Measured& find(int joint) const;
  model::Vec3 place_from_centre(const model::Joint& joint) const;

  const model::Model* model_;
  const Bodies* bodies_;
  std::vector<Measured> measured_;  ///< Bullet keeps pointers to these
};

}  // namespace pbmpi::bullet
