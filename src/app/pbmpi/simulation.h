/// The objects that step a run: driver, steppers, estimator.
#pragma once

#include <memory>
#include <vector>

#include "app/pbmpi/work.h"
#include "mpi/comm/communicator.h"
#include "mpi/frame/frame_driver.h"
#include "stability/on_blowup.h"
#include "stepping/estimator.h"
#include "stepping/space_stepper.h"
#include "stepping/stepper.h"

namespace pbmpi::app {

/// A driver and what it borrows.
struct Simulation {
  std::unique_ptr<stability::GuardSettings> guards;
  std::unique_ptr<stepping::WorldStepper> worlds;
  std::vector<std::unique_ptr<stepping::SpaceStepper>> spaces;  ///< for the worlds of this rank's group
  std::unique_ptr<stepping::Estimator> estimator;               ///< with FEEC, for whole worlds
  std::vector<std::unique_ptr<stepping::SpaceStepper>> estimate_spaces;  ///< with FEEC, like `spaces`
  std::unique_ptr<mpi::FrameDriver> driver;
};

/// Collective. `work`, except its states, which the driver copies, is borrowed for as long as the driver
/// lives. Throws core::InputError for settings that a stepper refuses.
Simulation make_simulation(const mpi::Communicator& comm, const Work& work);

}  // namespace pbmpi::app
