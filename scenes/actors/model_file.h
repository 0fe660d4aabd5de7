/// Files of other simulators' models, whichever of the known formats they have.
#pragma once

#include <set>
#include <string>

#include "scenes/links/links.h"
#include "scenes/xml/notes.h"

namespace pbmpi::scenes {

/// Ends of the names of model files, e.g. ".urdf".
bool is_model_file(const std::string& path);

/// Reads MJCF (root `<mujoco>`) or URDF (root `<robot>`); `file`: what messages call it; `leave_out`: names
/// of elements or types that are dropped instead of refused. Throws core::InputError "file:line:column: ...".
links::ModelFile read_model_file(const std::string& text, const std::string& file,
                                 const std::set<std::string>& leave_out, xml::Notes& notes);

}  // namespace pbmpi::scenes
