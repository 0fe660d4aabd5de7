/// Steps worlds with the Open Dynamics Engine.
#pragma once

#include <memory>
#include <string>

#include "ode/objects/warning_sink.h"
#include "stepping/stepper.h"

namespace pbmpi::ode {

/// StepperKind::quick steps with dWorldQuickStep (`iterations` sweeps, SOR factor 1.3), `direct` with
/// dWorldStep (the big-matrix reference; `iterations` has no meaning for it).
///
/// ODE's messages during a stepper's calls go to `warn`: the first of each number at once, the rest as a
/// count when the stepper is destroyed. A world that becomes NaN is no longer stepped: its observables show
/// it, and the other worlds go on. Any other error of ODE, for which ODE would end the process, is thrown as
/// core::RunError; the stepper must not be stepped again after that.
///
/// Throws core::InputError for dt <= 0 or iterations < 1, and from add() for a joint that ODE cannot express.
/// Steppers of one process must not step at the same time in two threads: ODE has one random seed and one set
/// of message handlers per process.
std::unique_ptr<stepping::WorldStepper> make_ode_stepper(const stepping::StepperSettings& settings,
                                                         WarningSink warn = warn_on_stderr);

/// "single" or "double": the precision of the ODE with which this program is built.
std::string precision_text();

}  // namespace pbmpi::ode
