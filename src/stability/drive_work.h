/// The work that motors and steered axes can have done.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "model/model.h"
#include "model/state.h"

namespace pbmpi::stability {

/// Upper bound of the work that a model's drives deliver between two states. Keeps only axes that a motor or
/// a steer event drives at any time, with the data that the bound needs.
class DriveWork {
 public:
  DriveWork(const model::Model& model, double dt_s);

  /// Upper bound of the work [J] delivered by the `num_steps` steps from `first_step` on, which end in
  /// `after`; joints that are broken in `before` deliver none. See allowed_work().
  double most(const model::State& before, const model::State& after, std::int64_t first_step,
              int num_steps) const;

 private:
  struct Axis {
    std::size_t joint = 0;
    int body_a = 0, body_b = model::no_body;
    int holder = model::no_body;  ///< body in whose frame the direction is fixed
    model::Vec3 direction;        ///< unit, in the holder's frame
    bool slides = false;
    double inertia = 0;                ///< [kg m^2] of a steered axis: the lighter body's largest
    model::AxisMotor motor;            ///< at the start
    std::vector<model::Event> events;  ///< motor and steer events of the axis, by step
  };
  struct Drive;

  static Drive drive_of(const Axis& axis, std::int64_t first_step, int num_steps);
  static double speed_of(const Axis& axis, const model::State& state);

  double dt_s_;
  std::vector<Axis> axes_;  ///< by joint and axis
};

}  // namespace pbmpi::stability
