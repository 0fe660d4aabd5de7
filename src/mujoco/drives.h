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

/// Walks through the events that set motors and limits. Their values depend only on the step, and on the
/// motors whose targets the caller has changed.
class Drives {
 public:
  /// The drives at the start of step `step`, before that step's own events. `model` is borrowed. Throws
  /// core::InputError for a motor or steer event on an axis that its joint lacks.
  Drives(const model::Model& model, std::int64_t step);

  /// Applies the events of step `step`; steps come in order. True if there was any.
  bool fire(std::int64_t step);
  void set_motor(int joint, int axis, const model::AxisMotor& motor) { motors_[joint][axis] = motor; }

  /// Writes the limits, the pins and the largest forces of motors into a compiled model.
  void show(const std::vector<Link>& links, const Coordinates& at, const Constraints& constraints,
            mjModel& compiled) const;
  /// Makes motors drive in the step whose constraint rows and reference accelerations have just been made:
  /// MuJoCo's joint friction has a bounded force and the target speed 0, which is replaced by the motor's.
  void aim(const std::vector<Link>& links, const Coordinates& at, const mjModel& compiled,
           mjData& data) const;

 private:
  double target(const LinkAxis& axis, int joint, double coordinate, double dt_s) const;
  bool set(const model::Event& event);

  const model::Model* model_;
  std::vector<std::array<model::AxisMotor, 2>> motors_;  ///< [joints]
  std::vector<std::array<model::AxisLimit, 2>> limits_;  ///< [joints]
  std::size_t next_ = 0;                                 ///< index of the next event
};

}  // namespace pbmpi::mujoco
