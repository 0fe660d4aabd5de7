/// Reads ROS's URDF, as far as a Model can express it (scenes/MODELS.md).
#pragma once

#include "scenes/links/links.h"
#include "scenes/xml/element.h"
#include "scenes/xml/include.h"
#include "scenes/xml/leave_out.h"

namespace pbmpi::scenes::urdf {

/// `root`: `<robot>`, from `file`; `texts` have its meshes. Meaning as in ROS's XML specifications of links
/// and joints. A root link called "world", or one without mass, is fixed to the world; any other is free.
/// Links of one robot do not touch each other. What cannot be expressed and affects motion is refused, unless
/// `leave_out` names it; its notes receive what is interpreted differently, elements and attributes of other
/// tools, and what is left out. Throws core::InputError "file:line:column: ...".
links::ModelFile read(const xml::Element& root, const std::string& file, const xml::Texts& texts,
                      const xml::LeaveOut& leave_out);

/// The files of meshes that its collisions name, as they are called in `texts`: `package://name/path` as it
/// stands, other names from the folder of the model.
std::vector<std::string> mesh_files(const std::string& file, const xml::Texts& texts);

}  // namespace pbmpi::scenes::urdf
