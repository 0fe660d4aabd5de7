/// What is counted in a step of MuJoCo.
#pragma once

#include <mujoco/mujoco.h>

#include "model/state.h"
#include "mujoco/coordinates.h"
#include "mujoco/touches.h"
#include "stepping/observables.h"

namespace pbmpi::mujoco {

/// Contacts, rows, islands and penetration of the step whose rows `data` has. Joints of the kinematic tree
/// have no rows; they connect islands all the same. A pair of bodies that joints hold is one island.
void count(const model::Model& model, const model::State& state, const Coordinates& at,
           const Touches& touches, const mjModel& compiled, const mjData& data, stepping::Observables& seen);

}  // namespace pbmpi::mujoco
