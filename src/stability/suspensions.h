/// Energy that suspensions store.
#pragma once

#include <cstddef>
#include <vector>

#include "model/model.h"
#include "model/state.h"

namespace pbmpi::stability {

/// A suspension that is not rigid, with the contiguous data from which its energy follows.
struct Suspension {
  std::size_t joint = 0;
  int body_a = 0, body_b = model::no_body;
  model::Vec3 anchor_a, anchor_b;  ///< [m], frames of the bodies
  model::Vec3 axis;                ///< unit, frame of a
  double stiffness = 0;            ///< [N/m]
};

/// The suspensions, by joint.
std::vector<Suspension> suspensions_of(const model::Model& model);

/// Potential energy [J]; 0 once its joint is broken.
double energy_of(const Suspension& suspension, const model::State& state);

}  // namespace pbmpi::stability
