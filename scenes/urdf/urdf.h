/// Reads ROS's URDF, in the part of it that a Model can express (docs/models.md).
#pragma once

#include <set>
#include <string>

#include "scenes/links/links.h"
#include "scenes/xml/element.h"
#include "scenes/xml/notes.h"

namespace pbmpi::scenes::urdf {

/// `root`: `<robot>`. Meaning as in ROS's XML specifications of links and joints. A root link called "world",
/// or without mass, stands fast in the world; any other is free. Links of one robot do not touch each other.
/// What cannot be expressed and changes how bodies move is refused, unless its element's name (of a shape, or
/// `mimic`) stands in `leave_out`; what is taken otherwise or left out goes to `notes`. Throws
/// core::InputError "file:line:column: ...".
links::ModelFile read(const xml::Element& root, const std::set<std::string>& leave_out, xml::Notes& notes);

}  // namespace pbmpi::scenes::urdf
