/// Model files of other simulators, in any of the known formats.
#pragma once

#include <set>
#include <string>

#include "scenes/links/links.h"
#include "scenes/xml/notes.h"

namespace pbmpi::scenes {

/// Does the path end like a model file's, e.g. in ".urdf"?
bool is_model_file(const std::string& path);

/// Reads MJCF (root `<mujoco>`) or URDF (root `<robot>`). `file`: its name in messages; `leave_out`: names of
/// elements or types that are dropped instead of refused. Throws core::InputError "file:line:column: ...".
links::ModelFile read_model_file(const std::string& text, const std::string& file,
                                 const std::set<std::string>& leave_out, xml::Notes& notes);

}  // namespace pbmpi::scenes
