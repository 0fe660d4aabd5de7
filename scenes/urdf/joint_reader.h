/// Reads URDF's `<joint>` elements one by one.
#pragma once

#include <string>

#include "scenes/links/links.h"
#include "scenes/xml/element.h"
#include "scenes/xml/leave_out.h"

namespace pbmpi::scenes::urdf {

/// A joint between two links.
struct ReadJoint {
  std::string parent, child;
  std::string parent_where, child_where;
  Pose origin;  ///< of the child in the parent's frame
  bool is_fixed = false;
  links::LinkJoint joint;  ///< not used if the joint is fixed
};

ReadJoint read_joint(const xml::Element& element, const xml::LeaveOut& leave_out);

}  // namespace pbmpi::scenes::urdf
