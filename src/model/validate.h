/// Rejects a model that no stepper can step.
#pragma once

#include <string>

#include "model/model.h"

namespace pbmpi::model {

/// Throws core::InputError, whose message begins with `where`, at the first of: no body; a mass that is not
/// finite and positive; an inertia that is not symmetric positive definite; a non-finite pose or velocity; a
/// quaternion that is not of unit length (1e-9); an index out of range; a size that is not positive; a joint
/// between a body and itself; an axis that is not a unit vector; low > high; an event before step 0; two
/// bodies of one name; a field of interest without extent, or without iterations outside.
void validate(const Model& model, const std::string& where);

}  // namespace pbmpi::model
