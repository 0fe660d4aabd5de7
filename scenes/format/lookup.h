/// Finds the bodies and joints that a scene file names, in a model that has all its bodies.
#pragma once

#include <string>

#include "model/model.h"

namespace pbmpi::scenes {

/// Index of the body or joint of that name. `where`: "file:line:column: what", the beginning of the message
/// of the core::InputError if there is none.
int named_body(const model::Model& model, const std::string& name, const std::string& where);
int named_joint(const model::Model& model, const std::string& name, const std::string& where);

}  // namespace pbmpi::scenes
