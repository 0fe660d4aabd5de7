/// Springs, dampers and servos of a joint's axis, as the motor of a Model's joint.
#pragma once

#include "scenes/links/links.h"
#include "scenes/xml/notes.h"

namespace pbmpi::scenes::links {

/// A motor that holds a velocity with at most a given force is dry friction, so `friction` is represented
/// exactly. A damper's force instead grows with the velocity, and a spring's with the displacement. The motor
/// then has the damper's force at 1 rad/s (1 m/s) or the spring's at 1 rad (1 m), whichever is larger, and
/// returns to the spring's target as an overdamped spring does, at the rate stiffness / damping, or in one
/// step of `dt_s` if that is slower. `where`: the place for the notes about it.
model::AxisMotor motor_of(const Drive& drive, double dt_s, const std::string& where, xml::Notes& notes);

}  // namespace pbmpi::scenes::links
