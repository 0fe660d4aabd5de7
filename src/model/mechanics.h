/// Energy and momentum of a world, from its model and state.
#pragma once

#include "model/model.h"
#include "model/state.h"

namespace pbmpi::model {

/// Kinetic and potential energy of one body [J]; the potential is that of its height above the world's
/// origin, against gravity.
double body_energy(const Model& model, const State& state, int body);

/// Kinetic and potential energy [J]; bodies are summed in order.
double mechanical_energy(const Model& model, const State& state);

/// Sum of mass times velocity [kg m/s]; bodies are summed in order.
Vec3 linear_momentum(const Model& model, const State& state);

/// Angular momentum about the origin of the world frame [kg m^2/s]; bodies are summed in order.
Vec3 angular_momentum(const Model& model, const State& state);

}  // namespace pbmpi::model
