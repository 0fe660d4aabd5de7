/// Steps worlds with Bullet.
#pragma once

#include <memory>
#include <string>

#include "stepping/stepper.h"

namespace pbmpi::bullet {

/// Whole worlds in double precision by Bullet's sequential impulses (btSequentialImpulseConstraintSolver),
/// `iterations` of them a step, with Bullet's shapes and colliders. docs/steppers.md says what each thing of
/// a model becomes.
///
/// A world that runs into numbers that are not finite is no longer stepped: it shows in its observables, a
/// line on standard error behind `warning_prefix` says so, and the other worlds go on. Throws
/// core::InputError for dt <= 0 or iterations < 1, and from add() for a joint that ODE could not express
/// either.
std::unique_ptr<stepping::WorldStepper> make_bullet_stepper(const stepping::StepperSettings& settings,
                                                            const std::string& warning_prefix);

}  // namespace pbmpi::bullet
