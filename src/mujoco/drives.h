/// Motors and limits of a world's joints, which events change.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <mujoco/mujoco.h>

#include "model/model.h"
#include "mujoco/constraints.h"
#include "mujoco/coordinates.h"

namespace pbmpi::mujoco {

/// Walks through the events that set motors and limits; what is set is a pure function of the step, and of
/// the motors that somebody has aimed elsewhere.
class Drives {
 public:
  /// `model` is borrowed. As it stands at the start of step `step`, before that step's own events. Throws
  /// core::InputError for a motor or steer event on an axis that its joint lacks.
  Drives(const model::Model& model, std::int64_t step);

  /// Sets what the events of step `step` set; steps come in order. True if there was any.
  bool fire(std::int64_t step);
  void set_motor(int joint, int axis, const model::AxisMotor& motor) { motors_[joint][axis] = motor; }

  /// Shows the limits, the pins and the most that motors give to a compiled model.
  void show(const std::vector<Link>& links, const Coordinates& at, const Constraints& constraints,
            mjModel& compiled) const;
  /// Lets motors drive in the step of which the constraint rows and their reference accelerations have just
  /// been made: MuJoCo's friction of a joint, whose force is bounded and which aims at a speed of 0, aims at
  /// the motor's instead.
  void aim(const std::vector<Link>& links, const Coordinates& at, const mjModel& compiled,
           mjData& data) const;

 private:
  double target(const LinkAxis& axis, int joint, double coordinate, double dt_s) const;
  bool set(const model::Event& event);

  const model::Model* model_;
  std::vector<std::array<model::AxisMotor, 2>> motors_;  ///< [joints]
  std::vector<std::array<model::AxisLimit, 2>> limits_;  ///< [joints]
  std::size_t next_ = 0;                                 ///< event
};

}  // namespace pbmpi::mujoco
