/// Converts bodies between the model and ODE.
#pragma once

#include <vector>

#include "model/model.h"
#include "model/state.h"
#include "ode/objects/handles.h"

namespace pbmpi::ode {

/// One ODE body per model body, at its initial pose, in the model's order. Gyroscopic torque (without it a
/// free body that spins about a middle axis does not tumble) is on unless the model turns it off: for a
/// sphere or a cube it is only rounding, but without it dWorldStep was seen to let a cube at rest creep at 12
/// mm/s. Auto-disable is off (a disabled body would have a counter that the state does not hold).
std::vector<dBodyID> make_bodies(dWorldID world, const model::Model& model);

/// Puts the bodies into `state` bit for bit. dBodySetQuaternion alone would normalise again, and a restarted
/// world would drift from one that continued.
void restore(const std::vector<dBodyID>& bodies, const model::State& state);

/// Reads the bodies into `state`, which has as many rows.
void copy_out(const std::vector<dBodyID>& bodies, model::State& state);

}  // namespace pbmpi::ode
