/// A world of a pack as it enters a step in parts.
#pragma once

#include <span>

#include "effects/field_of_interest.h"
#include "model/model.h"
#include "model/state.h"
#include "model/step_memory.h"
#include "solver/parts/island_shares.h"

namespace pbmpi::solver {

struct PartedWorld {
  const model::Model* model = nullptr;
  std::span<const int> bodies;     ///< the bodies that are to move
  model::SolvedContacts contacts;  ///< between these bodies, and approaches
  /// The field that has sorted the bodies; null without the effect.
  const effects::FieldOfInterest* field = nullptr;
  /// The shares that have sorted the bodies; null where all islands get the same.
  IslandShares* shares = nullptr;
  /// With `shares`: the world before the step, at least its quiet bodies and the joints' forces; and room for
  /// these bodies' poses and velocities after the step.
  const model::State* before = nullptr;
  model::State* after = nullptr;
};

}  // namespace pbmpi::solver
