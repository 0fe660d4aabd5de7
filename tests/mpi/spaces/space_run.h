/// Runs one world cut into spaces on the ranks of a test, and the same world in one piece.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "mpi/spaces/space_driver.h"
#include "mpi/worlds/world_driver.h"
#include "stepping/stepper.h"
#include "stepping/stepper_traits.h"

namespace pbmpi::testing_support {

using SharedModel = std::shared_ptr<const model::Model>;

SharedModel share(model::Model model);

/// All ranks of the test.
const mpi::Communicator& world();

/// Puts the geoms of a body into a space; returns the body.
int add_to_space(model::Model& model, int body, int space);

/// 2 warm-up and `frames` measured frames of 3 steps.
mpi::WorldRunSettings space_settings(int frames = 20);

/// Distinct placements of four spaces: every `stride`-th of the 256 on four ranks, modulo `num_ranks`.
std::vector<mpi::Placement> placements_of_four_spaces(int num_ranks, int stride);

struct SpaceRun {
  mpi::WorldRunResult result;
  std::vector<stepping::RunEvent> events;
  std::vector<int> idle_ranks;
  std::vector<int> owners;                  ///< at the end
  std::int64_t contacts_checked = 0;        ///< on root
  std::int64_t contacts_ahead_checked = 0;  ///< those that are speculative contacts of fast bodies
  std::int64_t messages = 0;                ///< of this rank
};

enum class Oracle { each_step, none };

/// Settings of sor with ODE's law, whose single substep makes the tests short.
inline const stepping::StepperSettings ode_steps =
    default_settings(stepping::StepperKind::sor, stepping::Law::ode);

/// A sor world with ODE's colliders.
std::unique_ptr<stepping::SpaceStepper> make_space_stepper(
    const SharedModel& model, const stepping::StepperSettings& stepper = ode_steps);

/// Runs the world cut into spaces; compares the contacts of each step with the oracle's unless told not to.
SpaceRun run_spaces(const mpi::Communicator& comm, const SharedModel& model,
                    const mpi::WorldRunSettings& settings = space_settings(),
                    const stepping::StepperSettings& stepper = ode_steps, Oracle oracle = Oracle::each_step);

/// State hash of the undecomposed world after the same number of steps on one rank.
std::uint64_t whole_hash(const SharedModel& model, const mpi::WorldRunSettings& settings = space_settings(),
                         const stepping::StepperSettings& stepper = ode_steps);

/// Expects the bits of the whole world, in both precisions, of `frames` measured frames of the world cut into
/// its four spaces, in every `stride`-th placement of these.
void expect_whole_in_placements(const SharedModel& model, int frames, int stride);

/// Four spaces in a row, 1 m apart: a pile of boxes, a chain that falls on its neighbours, a pile, and loose
/// balls that roll from one end to the other and are launched into other spaces.
model::Model neighbours();

/// Any variant of neighbours(), with a launch that puts a ball into a box of another space in step 22.
model::Model on_collision_course(model::Model model);

/// neighbours() in which two balls are shot at each other above the piles, and two through the piles, at 60
/// to 90 m/s.
model::Model shoot_out();

}  // namespace pbmpi::testing_support
