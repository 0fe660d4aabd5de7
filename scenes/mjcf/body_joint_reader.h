/// MJCF's `<joint>` and `<freejoint>`.
#pragma once

#include "scenes/links/links.h"
#include "scenes/mjcf/settings/compiler.h"
#include "scenes/xml/leave_out.h"

namespace pbmpi::scenes::mjcf {

/// A joint, with the data that its servos need.
struct ReadJoint {
  links::LinkJoint joint;
  double most_servo_force = model::infinity;  ///< [N m] or [N] limit of all servos together
};

/// `attributes` include the defaults of the joint's class; `name`: used for a joint without a name.
ReadJoint read_joint(xml::Attributes attributes, const std::string& name, const Compiler& compiler,
                     const Option& option, const xml::LeaveOut& leave_out);

links::LinkJoint read_free_joint(const xml::Element& element, const std::string& name,
                                 const xml::LeaveOut& leave_out);

}  // namespace pbmpi::scenes::mjcf
