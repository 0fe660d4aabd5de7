#include "app/pbmpi/simulation.h"

#include <utility>

#include "app/common/step_arguments.h"
#include "engines/stepper_factory.h"
#include "mpi/comm/agreement.h"
#include "mpi/spaces/space_driver.h"
#include "mpi/worlds/world_driver.h"
#include "stability/guarded_stepper.h"

namespace pbmpi::app {
namespace {

mpi::WorldRunSettings driver_settings(const RunSpec& spec) {
  mpi::WorldRunSettings settings;
  settings.num_worlds = spec.num_worlds;
  settings.first_world = spec.first_world();
  settings.warmup = spec.warmup;
  settings.frames = spec.frames;
  settings.steps_per_frame = spec.steps_per_frame;
  settings.dt_s = spec.stepper.dt_s;
  settings.budget_s = spec.budget_s;
  settings.stop_at_blowup = spec.on_blowup == stability::OnBlowup::stop;
  settings.profile = spec.records.has(Record::islands);
  settings.first_frame = spec.checkpoint.first_frame;
  return settings;
}

stability::GuardSettings guard_settings(const RunSpec& spec) {
  return {spec.on_blowup,
          spec.stepper,
          [](const stepping::StepperSettings& settings) {
            return engines::make_stepper(settings, "stepped again: ");
          },
          {}};
}

using SpaceSteppers = std::vector<std::unique_ptr<stepping::SpaceStepper>>;

/// Space steppers for the worlds of this rank's group.
SpaceSteppers make_space_steppers(const mpi::Communicator& comm, const Work& work,
                                  const stepping::StepperSettings& settings) {
  return mpi::agree_on_errors(comm, [&] {
    const mpi::RankGroups& groups = work.spec.groups;
    SpaceSteppers steppers;
    for (const int world : groups.worlds_of(groups.group_of_rank(comm.rank())))
      steppers.push_back(engines::make_space_stepper(settings, build_world(work, world)));
    return steppers;
  });
}

std::vector<stepping::SpaceStepper*> borrowed(const SpaceSteppers& steppers) {
  std::vector<stepping::SpaceStepper*> pointers;
  for (const auto& stepper : steppers) pointers.push_back(stepper.get());
  return pointers;
}

}  // namespace

Simulation make_simulation(const mpi::Communicator& comm, const Work& work) {
  const RunSpec& spec = work.spec;
  Simulation simulation;
  const auto build = [&work](int world) { return build_world(work, world); };
  if (spec.decomposition == Decomposition::spaces) {
    simulation.spaces = make_space_steppers(comm, work, spec.stepper);
    simulation.guards = std::make_unique<stability::GuardSettings>(guard_settings(spec));
    auto driver = std::make_unique<mpi::SpaceDriver>(comm, borrowed(simulation.spaces), spec.groups,
                                                     driver_settings(spec), work.states);
    driver->watch(*simulation.guards);
    if (spec.estimate) {
      simulation.estimate_spaces = make_space_steppers(comm, work, *spec.estimate);
      driver->estimate_with(borrowed(simulation.estimate_spaces));
    }
    simulation.driver = std::move(driver);
  } else {
    auto guarded = std::make_unique<stability::GuardedStepper>(engines::make_stepper(spec.stepper),
                                                               guard_settings(spec));
    if (spec.estimate) simulation.estimator = make_estimator(*spec.estimate);
    auto driver =
        std::make_unique<mpi::WorldDriver>(comm, *guarded, build, driver_settings(spec), work.states);
    driver->set_event_source(*guarded);
    simulation.worlds = std::move(guarded);
    if (simulation.estimator) driver->set_estimator(*simulation.estimator);
    simulation.driver = std::move(driver);
  }
  return simulation;
}

}  // namespace pbmpi::app
