/// Fires the events of a world step by step.
#pragma once

#include <cstdint>
#include <vector>

#include "model/model.h"
#include "ode/objects/handles.h"
#include "ode/objects/held_poses.h"

namespace pbmpi::ode {

/// Walks through Model::events. Joint settings are a pure function of the step; launches act on the state.
class Events {
 public:
  /// `model` and `poses` are borrowed. Throws core::InputError for a motor or steer event on an axis that its
  /// joint lacks.
  Events(const model::Model& model, const std::vector<dBodyID>& bodies, const std::vector<dJointID>& joints,
         HeldPoses& poses);

  /// Brings the joints, fresh from make_joints(), to their settings at the start of step `step`, before that
  /// step's own events. Launches of earlier steps are already part of the state.
  void skip_to(std::int64_t step);
  /// Makes this motor drive an axis from now on.
  void set_motor(int joint, int axis, const model::AxisMotor& motor);
  /// Fires the events of step `step`. Steps come in order, without a gap, from the step of skip_to().
  void fire(std::int64_t step) {
    while (next_ < model_->events.size() && model_->events[next_].step <= step) {
      apply(model_->events[next_++]);
    }
  }

 private:
  void apply(const model::Event& event);
  void set_joint(const model::Event& event);

  const model::Model* model_;
  std::vector<dBodyID> bodies_;
  std::vector<dJointID> joints_;
  HeldPoses* poses_;
  std::size_t next_ = 0;
};

}  // namespace pbmpi::ode
