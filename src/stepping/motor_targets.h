/// The velocities that callers have set for the motors of a world.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "model/model.h"

namespace pbmpi::stepping {

/// The targets of WorldStepper::set_motor_velocity() in one world.
class MotorTargets {
 public:
  struct Target {
    int joint = 0, axis = 0;
    model::AxisMotor motor;  ///< what drives the axis: the target velocity, all else as in the model
  };

  /// Makes the motor of an axis aim at `velocity` from step `step` on, whose events are still to come.
  /// Returns what drives the axis now, valid until the next call, or null if the motor already aims at it.
  /// Throws core::InputError for an axis that has no motor, neither at the start nor by an event, and for a
  /// velocity that is not finite.
  const Target* set(const model::Model& model, std::int64_t step, int joint, int axis, double velocity);

  /// Passes the events of `num_steps` steps from `first_step` on: a motor that one of them sets loses its
  /// target and follows the event.
  void pass(const model::Model& model, std::int64_t first_step, std::int64_t num_steps = 1);

  /// Moves to before step `step`: the targets stay, force and hold rate become those of the motors before
  /// that step.
  void move_to(const model::Model& model, std::int64_t step);

  /// Does a motor of the joint keep its axis moving, by its target or after the events of all steps before
  /// `step`?
  bool drive(const model::Model& model, std::int64_t step, int joint) const;

  std::span<const Target> all() const { return targets_; }

 private:
  std::vector<Target> targets_;  ///< sorted by joint and axis
};

}  // namespace pbmpi::stepping
