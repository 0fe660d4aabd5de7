/// Model files of other simulators, in any of the known formats.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "scenes/links/links.h"
#include "scenes/xml/include.h"
#include "scenes/xml/notes.h"

namespace pbmpi::scenes {

/// Does the path end like a model file's, e.g. in ".urdf"?
bool is_model_file(const std::string& path);

/// How a model file is to be read.
struct ModelChoices {
  std::set<std::string> leave_out;  ///< elements, types or attributes that are dropped instead of refused
  std::string keyframe;  ///< of an MJCF, from which the model starts; empty: from its bodies' places
};

/// Reads MJCF (root `<mujoco>`) or URDF (root `<robot>`). `file`: its name in `texts`, which also have what
/// it includes and attaches, and in messages. Throws core::InputError "file:line:column: ...".
links::ModelFile read_model_file(const xml::Texts& texts, const std::string& file,
                                 const ModelChoices& choices, xml::Notes& notes);

/// The files that a model includes or attaches, directly or not, and those of its meshes, that `texts` lack.
std::vector<std::string> missing_files(const xml::Texts& texts, const std::string& file);

}  // namespace pbmpi::scenes
