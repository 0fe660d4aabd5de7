/// Steps worlds with Bullet.
#pragma once

#include <memory>
#include <string>

#include "stepping/stepper.h"

namespace pbmpi::bullet {

/// Steps whole worlds in double precision with Bullet's sequential impulses
/// (btSequentialImpulseConstraintSolver), `iterations` iterations per step, and with Bullet's shapes and
/// colliders. docs/steppers.md lists what each part of a model becomes.
///
/// A world with non-finite numbers is no longer stepped: its observables show it, a line on standard error
/// after `warning_prefix` reports it, and the other worlds go on. Throws core::InputError for dt <= 0 or
/// iterations < 1, and from add() for a joint that ODE could not express either.
std::unique_ptr<stepping::WorldStepper> make_bullet_stepper(const stepping::StepperSettings& settings,
                                                            const std::string& warning_prefix);

}  // namespace pbmpi::bullet
