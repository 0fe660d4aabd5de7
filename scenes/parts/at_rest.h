/// A world before its action.
#pragma once

#include "model/model.h"

namespace pbmpi::scenes {

/// Takes out all events, stops all bodies, and sets all motors to zero velocity. A projectile that would
/// start in flight lies on the highest ground plane below it, or stays where it is if there is none.
void bring_to_rest(model::Model& model);

}  // namespace pbmpi::scenes
