/// MJCF's `<actuator>`: servos become part of the drive along a joint's axis.
#pragma once

#include "scenes/mjcf/places.h"

namespace pbmpi::scenes::mjcf {

/// Reads the elements of `<actuator>`. All arguments are borrowed.
class ActuatorReader {
 public:
  ActuatorReader(const Places& places, links::Mechanism& mechanism)
      : joints_(places.joints, "joint"), mechanism_(mechanism) {}

  /// Reads one element of `part`. `control`: 0, as in MuJoCo before anybody sets it, or a keyframe's; or as
  /// close to it as a `ctrlrange` allows. A position servo holds its joint there, a velocity servo resists
  /// like a damper or drives, a motor does nothing at 0. Where a file has its joint several times, each of
  /// them gets the servo.
  void read(const xml::Element& element, double control, const Part& part);

 private:
  void read_servo(const xml::Element& element, double control, const Part& part);
  void drive(xml::Attributes& actuator, const xml::Element& element, double control, const JointPlace& at,
             const Part& part);

  PlaceIndex<JointPlace> joints_;
  links::Mechanism& mechanism_;
};

}  // namespace pbmpi::scenes::mjcf
