/// The loads that the joints of the tree exert on their bodies.
#pragma once

#include <vector>

#include <mujoco/mujoco.h>

#include "effects/breakage.h"
#include "model/model.h"
#include "model/step_memory.h"
#include "mujoco/coordinates.h"

namespace pbmpi::mujoco {

class JointLoads {
 public:
  /// All are borrowed.
  JointLoads(const model::Model& model, const std::vector<Link>& links, const Coordinates& at);

  /// Measures the step that was just solved, while MuJoCo's poses are still those before it.
  void measure(const mjModel& compiled, mjData& data);
  /// Force [N] on the joint's first body, and torque [N m] about the point of effects::Reaction, world frame.
  /// Both include limits and motors; zero for a joint that closes a loop or is broken.
  model::JointForce force(int joint) const { return forces_[joint]; }
  effects::Reaction reaction(int joint) const {
    return {forces_[joint].force.norm(), forces_[joint].torque.norm()};
  }

 private:
  const model::Model* model_;
  const std::vector<Link>* links_;
  const Coordinates* at_;
  std::vector<model::JointForce> forces_;  ///< [joints]
};

}  // namespace pbmpi::mujoco
