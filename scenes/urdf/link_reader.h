/// URDF's `<link>` and `<joint>`, each for itself.
#pragma once

#include <set>
#include <string>

#include "scenes/links/links.h"
#include "scenes/xml/element.h"
#include "scenes/xml/notes.h"

namespace pbmpi::scenes::urdf {

/// `<origin xyz rpy>`; none is none.
Pose read_origin(const xml::Element& element);

/// Mass and geoms; what joins it to others is left to the caller.
links::Link read_link(const xml::Element& element, const std::set<std::string>& leave_out, xml::Notes& notes);

/// A joint between two links.
struct ReadJoint {
  std::string parent, child;
  std::string parent_where, child_where;
  Pose origin;  ///< of the child in the parent's frame
  bool is_fixed = false;
  links::LinkJoint joint;  ///< unless it is fixed
};

ReadJoint read_joint(const xml::Element& element, const std::set<std::string>& leave_out, xml::Notes& notes);

}  // namespace pbmpi::scenes::urdf
