/// MJCF's `<joint>` and `<freejoint>`.
#pragma once

#include "scenes/links/links.h"
#include "scenes/mjcf/compiler.h"
#include "scenes/xml/notes.h"

namespace pbmpi::scenes::mjcf {

/// A joint, and what its servos need to know.
struct ReadJoint {
  links::LinkJoint joint;
  double start = 0;  ///< [rad] or [m] its value at the start (`ref`), from which they count
  double most_servo_force = model::infinity;  ///< [N m] or [N] of all of them together
};

/// `attributes`: with the defaults of the joint's class; `name`: of a joint that has none.
ReadJoint read_joint(xml::Attributes attributes, const std::string& name, const Compiler& compiler,
                     const Option& option, xml::Notes& notes);

links::LinkJoint read_free_joint(const xml::Element& element, const std::string& name);

}  // namespace pbmpi::scenes::mjcf
