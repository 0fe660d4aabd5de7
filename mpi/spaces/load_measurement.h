/// Measures what the spaces of a world cost in a frame.
#pragma once

#include <span>

#include "core/clock.h"
#include "effects/field_of_interest.h"
#include "mpi/spaces/plan/space_loads.h"
#include "mpi/spaces/plan/space_ownership.h"
#include "mpi/spaces/step/frame_report.h"
#include "stepping/space_stepper.h"

namespace pbmpi::mpi {

/// The measurements of a frame, and what they were measured on.
struct MeasuredFrame {
  const stepping::SpaceStepper* stepper = nullptr;  ///< gives the map of spaces and the lanes
  const effects::FieldOfInterest* field = nullptr;  ///< null without one
  const SpaceOwnership* ownership = nullptr;        ///< the ownership during the frame
  const FrameFindings* findings = nullptr;          ///< findings of its last step
  std::span<const core::PhaseTimes> times;          ///< [num_ranks] seconds a frame by phase
  int steps_per_frame = 1;
};

/// Splits the ranks' seconds. Seconds of collision go to the spaces of the rank that spent them, by contact
/// rows and bodies. Seconds of the solver go to batches of equal units and to contacts, by their rows, over
/// all ranks (an island costs the same anywhere).
SpaceLoads measure_loads(const MeasuredFrame& frame);

}  // namespace pbmpi::mpi
