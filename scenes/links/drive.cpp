#include "scenes/links/drive.h"

#include <algorithm>

namespace pbmpi::scenes::links {

model::AxisMotor motor_of(const Drive& drive, double dt_s, const std::string& where, xml::Notes& notes) {
  constexpr double reference = 1;  // [rad/s], [m/s], [rad], [m]
  const double viscous = reference * std::max(drive.damping, drive.stiffness);
  model::AxisMotor motor;
  motor.velocity = drive.velocity;
  motor.max_force = drive.friction + std::min(viscous, drive.most_force);
  if (drive.stiffness > 0) {
    const double most_rate = 1 / dt_s;
    const bool is_slower = drive.stiffness < drive.damping * most_rate;
    motor.hold_rate = is_slower ? drive.stiffness / drive.damping : most_rate;
    motor.velocity += motor.hold_rate * drive.target;
    notes.add(
        where,
        "its spring or position servo becomes a motor, which returns at the rate stiffness / damping with "
        "at most the torque of the spring at 1 rad (the force at 1 m), and never swings");
  } else if (drive.damping > 0) {
    notes.add(where,
              "its damping becomes dry friction: the torque that it has at 1 rad/s (the force at 1 m/s)");
  }
  return motor;
}

}  // namespace pbmpi::scenes::links
