/// Reads MuJoCo's MJCF, as far as a Model can express it (scenes/MODELS.md).
#pragma once

#include <string>

#include "scenes/links/links.h"
#include "scenes/xml/include.h"
#include "scenes/xml/leave_out.h"

namespace pbmpi::scenes::mjcf {

/// `file`: its name in `texts`, which also have what it includes and attaches. Meaning and defaults as in
/// MuJoCo's XML reference. Elements that cannot be expressed and affect motion are refused, unless
/// `leave_out` names them, or a type or an attribute that is the reason; its notes receive what is
/// interpreted differently or left out. `keyframe`: the `<key>` from which the mechanism starts; empty: from
/// the places of its bodies. Throws core::InputError "file:line:column: ...".
links::ModelFile read(const std::string& file, const xml::Texts& texts, const std::string& keyframe,
                      const xml::LeaveOut& leave_out);

}  // namespace pbmpi::scenes::mjcf
