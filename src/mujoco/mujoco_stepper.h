/// Steps worlds with MuJoCo.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "model/model.h"
#include "stepping/stepper.h"

namespace pbmpi::mujoco {

/// Each articulation is a kinematic tree in MuJoCo's joint coordinates. MuJoCo's Newton solver makes at most
/// `iterations` iterations, with elliptic friction cones, and the integrator is the implicit one
/// (docs/steppers.md, "mujoco"). Warnings go to stderr after `warning_prefix`.
///
/// A world that MuJoCo cannot continue (NaN, or numbers beyond 1e10) is no longer stepped: its velocities
/// become NaN, its observables show it, and the other worlds go on. Any other error of MuJoCo, for which
/// MuJoCo would end the process, is thrown as core::RunError; the stepper must not be stepped again after
/// that.
///
/// Throws core::InputError for dt <= 0 or iterations < 1, and from add() and set_state() for a world that
/// MuJoCo cannot step (refusals()), or that is too large for it. Steppers of one process must not step at the
/// same time in two threads: MuJoCo has one set of message handlers per process.
std::unique_ptr<stepping::WorldStepper> make_mujoco_stepper(const stepping::StepperSettings& settings,
                                                            const std::string& warning_prefix = "");

/// Why MuJoCo cannot step worlds of this model, one sentence each, without a full stop; nothing if it can.
std::vector<std::string> refusals(const model::Model& model);

/// The features of this model that MuJoCo cannot express, one sentence each, without a full stop: refusals(),
/// and the features that it drops or treats differently.
std::vector<std::string> inexpressible(const model::Model& model);

/// Version of the library in use, e.g. "2.2.2".
std::string mujoco_version();

}  // namespace pbmpi::mujoco
