/// Reads MuJoCo's MJCF, as far as a Model can express it (docs/models.md).
#pragma once

#include <set>
#include <string>

#include "scenes/links/links.h"
#include "scenes/xml/element.h"
#include "scenes/xml/notes.h"

namespace pbmpi::scenes::mjcf {

/// `root`: `<mujoco>`. Meaning and defaults as in MuJoCo's XML reference. Elements that cannot be expressed
/// and affect motion are refused, unless their name is in `leave_out`; `notes` receives what is interpreted
/// differently or left out. Throws core::InputError "file:line:column: ...".
links::ModelFile read(const xml::Element& root, const std::set<std::string>& leave_out, xml::Notes& notes);

}  // namespace pbmpi::scenes::mjcf
