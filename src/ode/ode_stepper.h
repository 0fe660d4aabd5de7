/// Steps worlds with the Open Dynamics Engine.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "model/stepper.h"

namespace pbmpi::ode {

/// Gets one line for people, without a newline, e.g. "ode: world 3, step 17: LCP internal error ...".
using WarningSink = std::function<void(const std::string& line)>;

/// Writes the line to standard error.
void warn_on_stderr(const std::string& line);

/// StepperKind::quick steps with dWorldQuickStep (`iterations` sweeps, SOR factor 1.3), `direct` with
/// dWorldStep (the big-matrix reference; `iterations` has no meaning for it).
///
/// ODE's messages of a stepper go to `warn`: the first of each number at once, the rest as a count when the
/// stepper is destroyed. A world that runs into NaN is no longer stepped: it shows in its observables, and
/// the other worlds go on. Any other error of ODE, at which it would end the process, is thrown as
/// core::RunError; the stepper must not be stepped again after that.
///
/// Throws core::InputError for dt <= 0 or iterations < 1, and from add() for a joint that ODE cannot express.
/// Steppers of one process must not step at the same time in two threads: ODE has one random seed and one
/// set of message handlers a process.
std::unique_ptr<model::WorldStepper> make_ode_stepper(const model::StepperSettings& settings,
                                                      WarningSink warn = warn_on_stderr);

}  // namespace pbmpi::ode
