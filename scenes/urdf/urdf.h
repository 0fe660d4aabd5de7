/// Reads ROS's URDF, as far as a Model can express it (scenes/MODELS.md).
#pragma once

#include "scenes/links/links.h"
#include "scenes/xml/element.h"
#include "scenes/xml/leave_out.h"

namespace pbmpi::scenes::urdf {

/// `root`: `<robot>`. Meaning as in ROS's XML specifications of links and joints. A root link called "world",
/// or one without mass, is fixed to the world; any other is free. Links of one robot do not touch each other.
/// What cannot be expressed and affects motion is refused, unless `leave_out` names it; its notes receive
/// what is interpreted differently, elements and attributes of other tools, and what is left out. Throws
/// core::InputError "file:line:column: ...".
links::ModelFile read(const xml::Element& root, const xml::LeaveOut& leave_out);

}  // namespace pbmpi::scenes::urdf
