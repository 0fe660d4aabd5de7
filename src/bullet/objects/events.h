/// Fires the events of a world step by step.
#pragma once

#include <cstdint>

#include "bullet/objects/held_poses.h"

namespace pbmpi::bullet {

/// Walks through Model::events. Joint settings are a pure function of the step; launches act on the state.
class Events {
 public:
  /// All are borrowed. Throws core::InputError for a motor or steer event on an axis that its joint lacks.
  Events(const model::Model& model, Bodies& bodies, AxisJoints& joints, HeldPoses& poses);

  /// Brings the joints from the model's settings to those at the start of step `step`, before that step's own
  /// events. Launches of earlier steps are already part of the state.
  void skip_to(std::int64_t step);
  /// Makes this motor drive an axis from now on.
  void set_motor(int joint, int axis, const model::AxisMotor& motor);
  /// Fires the events of step `step`. Steps come in order, without a gap, from the step of skip_to().
  void fire(std::int64_t step);

 private:
  void apply(const model::Event& event);
  void set_joint(const model::Event& event);

  const model::Model* model_;
  Bodies* bodies_;
  AxisJoints* joints_;
  HeldPoses* poses_;
  std::size_t next_ = 0;
};

}  // namespace pbmpi::bullet
