/// Where the field of interest is, told to all ranks.
#pragma once

#include "core/clock.h"
#include "mpi/spaces/step/step_context.h"

namespace pbmpi::mpi {

/// With the effect "field_of_interest" that follows a body, the owner of that body sends its position to all
/// other ranks: one message of three numbers each a step. Whether an island is inside is then found by the
/// rank that solves it, which has all its bodies and contacts.
///
/// SpaceStep calls post() after the events of the step and take() after collision. Both do nothing without a
/// field and for a field that stands still; where all bodies are on one rank no message is sent.
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
