/// The moving part of a world: what is hashed, sent, recorded and restored.
#pragma once

#include <cstdint>
#include <vector>

#include "model/model.h"

namespace pbmpi::model {

/// One row a body, contiguous, world frame.
struct State {
  std::vector<Vec3> position;          ///< [num_bodies][3] m, centres of mass
  std::vector<Quat> orientation;       ///< [num_bodies][4] (w, x, y, z)
  std::vector<Vec3> velocity;          ///< [num_bodies][3] m/s
  std::vector<Vec3> angular_velocity;  ///< [num_bodies][3] rad/s

  int num_bodies() const { return static_cast<int>(position.size()); }
  void resize(int num_bodies);
};

/// The state in which `model` starts.
State initial_state(const Model& model);

/// Hash of all bits of the state, body by body. Equal states have equal hashes on every machine.
std::uint64_t hash(const State& state);

/// Bodies of which any number is NaN or infinite.
int count_nonfinite(const State& state);

}  // namespace pbmpi::model
