/// What URDF's elements have in common.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "scenes/parts/parts.h"
#include "scenes/xml/element.h"
#include "scenes/xml/leave_out.h"

namespace pbmpi::scenes::urdf {

/// The child of that name, of which there is at most one; null without one.
const xml::Element* child_of(const xml::Element& element, std::string_view name);
/// Refuses an element without such a child.
const xml::Element& need_child(const xml::Element& element, std::string_view name);

/// Passes over a child element that pbmpi does not know, with a note: another tool's. Refuses one that may be
/// a misspelling of a `known` one, or that would affect the motion.
void pass_over(const xml::Element& child, const xml::Element& parent, const std::vector<std::string>& known,
               const xml::LeaveOut& leave_out);

/// pass_over() for all children that are not `known`.
void pass_over_unknown(const xml::Element& element, const std::vector<std::string>& known,
                       const xml::LeaveOut& leave_out);

/// Reads `<origin xyz rpy>`, or quat_xyzw instead of rpy; the identity without one.
Pose read_origin(const xml::Element& element, const xml::LeaveOut& leave_out);

}  // namespace pbmpi::scenes::urdf
