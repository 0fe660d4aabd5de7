/// A world before its action.
#pragma once

#include "model/model.h"

namespace pbmpi::scenes {

/// `model` without events, with all bodies at rest and all motors set to zero velocity. A projectile that
/// would start in flight lies on the highest ground plane below it, or stays where it is if there is none.
model::Model at_rest(model::Model model);

}  // namespace pbmpi::scenes
