/// MJCF's `<actuator>`: servos become part of the drive along a joint's axis.
#pragma once

#include <string>
#include <vector>

#include "scenes/links/links.h"
#include "scenes/mjcf/compiler.h"
#include "scenes/mjcf/defaults.h"
#include "scenes/xml/notes.h"

namespace pbmpi::scenes::mjcf {

/// The place of a joint in the mechanism, and its data as in ReadJoint.
struct JointPlace {
  std::string name;
  int link = 0, joint = 0;
  double most_servo_force = model::infinity;
};

/// Reads one element of `<actuator>`. `control`: 0, as in MuJoCo before anybody sets it, or a keyframe's; or
/// as close to it as a `ctrlrange` allows. A position servo holds its joint there, a velocity servo resists
/// like a damper or drives, a motor does nothing at 0.
void read_actuator(const xml::Element& element, double control, const Defaults& defaults,
                   const Compiler& compiler, const std::vector<JointPlace>& joints,
                   const xml::LeaveOut& leave_out, links::Mechanism& mechanism);

}  // namespace pbmpi::scenes::mjcf
