/// MJCF's `<actuator>`: servos become part of the drive along a joint's axis.
#pragma once

#include <set>
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
  double start = 0;
  double most_servo_force = model::infinity;
};

/// All controls are 0, as in MuJoCo before anybody sets them, or as close to 0 as a `ctrlrange` allows: a
/// position servo holds the joint's zero, a velocity servo resists like a damper, a motor does nothing.
void read_actuators(const xml::Element& element, const Defaults& defaults, const Compiler& compiler,
                    const std::vector<JointPlace>& joints, const std::set<std::string>& leave_out,
                    links::Mechanism& mechanism, xml::Notes& notes);

}  // namespace pbmpi::scenes::mjcf
