/// Steps worlds with Bullet.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "model/model.h"
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

/// The features of this model that Bullet steps differently from ODE, or not at all, one per line, e.g.
/// "max_per_pair 16: a pair of geoms has 4 contacts at most".
std::vector<std::string> inexpressible(const model::Model& model);

}  // namespace pbmpi::bullet
