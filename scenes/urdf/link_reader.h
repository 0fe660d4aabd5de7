/// Reads URDF's `<link>` and `<joint>` elements one by one.
#pragma once

#include <set>
#include <string>

#include "scenes/links/links.h"
#include "scenes/xml/element.h"
#include "scenes/xml/notes.h"

namespace pbmpi::scenes::urdf {

/// Reads `<origin xyz rpy>`; the identity without one.
Pose read_origin(const xml::Element& element);

/// Reads mass and geoms; the caller adds the joints to other links.
links::Link read_link(const xml::Element& element, const std::set<std::string>& leave_out, xml::Notes& notes);

/// A joint between two links.
struct ReadJoint {
  std::string parent, child;
  std::string parent_where, child_where;
  Pose origin;  ///< of the child in the parent's frame
  bool is_fixed = false;
  links::LinkJoint joint;  ///< not used if the joint is fixed
};

ReadJoint read_joint(const xml::Element& element, const std::set<std::string>& leave_out, xml::Notes& notes);

}  // namespace pbmpi::scenes::urdf
