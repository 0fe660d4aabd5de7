/// MJCF's `<actuator>`: servos become part of the drive along a joint's axis.
#pragma once

#include <string>
#include <vector>

#include "scenes/links/links.h"
#include "scenes/mjcf/defaults.h"
#include "scenes/parts/name_index.h"

namespace pbmpi::scenes::mjcf {

/// The place of a joint in the mechanism, and its data as in ReadJoint.
struct JointPlace {
  std::string name;
  int link = 0, joint = 0;
  double most_servo_force = model::infinity;
};

/// Reads the elements of `<actuator>`. All arguments are borrowed.
class ActuatorReader {
 public:
  ActuatorReader(const Context& context, const std::vector<JointPlace>& joints, links::Mechanism& mechanism)
      : context_(context), joints_(joints), mechanism_(mechanism) {}

  /// Reads one element. `control`: 0, as in MuJoCo before anybody sets it, or a keyframe's; or as close to it
  /// as a `ctrlrange` allows. A position servo holds its joint there, a velocity servo resists like a damper
  /// or drives, a motor does nothing at 0.
  void read(const xml::Element& element, double control);

 private:
  const JointPlace& read_driven_joint(xml::Attributes& actuator);
  void read_servo(const xml::Element& element, double control);
  void require_idle(const xml::Element& element, double control) const;

  const Context& context_;
  const std::vector<JointPlace>& joints_;
  links::Mechanism& mechanism_;
  NameIndex joint_names_;
};

}  // namespace pbmpi::scenes::mjcf
