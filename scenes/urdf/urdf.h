/// Reads ROS's URDF, as far as a Model can express it (docs/models.md).
#pragma once

#include <set>
#include <string>

#include "scenes/links/links.h"
#include "scenes/xml/element.h"
#include "scenes/xml/notes.h"

namespace pbmpi::scenes::urdf {

/// `root`: `<robot>`. Meaning as in ROS's XML specifications of links and joints. A root link called "world",
/// or one without mass, is fixed to the world; any other is free. Links of one robot do not touch each other.
/// Elements that cannot be expressed and affect motion are refused, unless their name (of a shape, or
/// `mimic`) is in `leave_out`; `notes` receives what is interpreted differently or left out. Throws
/// core::InputError "file:line:column: ...".
links::ModelFile read(const xml::Element& root, const std::set<std::string>& leave_out, xml::Notes& notes);

}  // namespace pbmpi::scenes::urdf
