/// Tells all ranks where the field of interest is.
#pragma once

#include "core/clock.h"
#include "mpi/spaces/step/step_context.h"

namespace pbmpi::mpi {

/// When the effect "field_of_interest" follows a body, the owner of that body sends its position to all other
/// ranks: one message of three numbers each a step. The rank that solves an island, which has all its bodies
/// and contacts, then decides whether the island is inside.
///
/// SpaceStep calls post() after the events of the step and take() after collision. Both do nothing without a
/// field or for a field that stands still; where all bodies are on one rank no message is sent.
class FieldCenter {
 public:
  /// `shared` is borrowed.
  explicit FieldCenter(StepContext& shared) : shared_(&shared) {}

  void post();
  void take(core::LapTimer& timer);

 private:
  /// Rank that owns the followed body; -1 if the field follows none.
  int owner() const;

  StepContext* shared_;
};

}  // namespace pbmpi::mpi
