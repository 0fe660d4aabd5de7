/// Counts what a step of MuJoCo solved.
#pragma once

#include <mujoco/mujoco.h>

#include "model/state.h"
#include "mujoco/coordinates.h"
#include "mujoco/touches.h"
#include "stepping/observables.h"

namespace pbmpi::mujoco {

/// Counts contacts, rows, islands and penetration of the step whose rows `data` has. Joints of the kinematic
/// tree have no rows, but still connect islands. A pair of bodies connected by joints is one island.
void count(const model::Model& model, const model::State& state, const Coordinates& at,
           const Touches& touches, const mjModel& compiled, const mjData& data, stepping::Observables& seen);

}  // namespace pbmpi::mujoco
