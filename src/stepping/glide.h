/// Motion without forces.
#pragma once

#include "model/state.h"

namespace pbmpi::stepping {

/// Moves all bodies for this time at their current velocities, as ODE's integrator does in one step: position
/// by h v, orientation by h/2 w q, normalised. Velocities do not change.
void glide(double seconds, model::State& state);

}  // namespace pbmpi::stepping
