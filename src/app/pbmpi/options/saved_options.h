/// The options that a checkpoint keeps, and those that a resumed run may change.
#pragma once

#include <string>

#include "app/pbmpi/options/options.h"

namespace pbmpi::app {

/// All options except the scene that decide the bits of a run, and those that a resumed run keeps unless told
/// otherwise: values as resolved, one "name = value" a line, as in a file of --config.
std::string saved_options(const RunSpec& spec);

/// Throws core::InputError unless `now` is the stepper of `saved`, without which its other options make no
/// sense. `path`: the checkpoint's.
void require_same_stepper(const std::string& path, const std::string& saved, stepping::StepperKind now);

/// Throws core::InputError unless `now` has the physics of `saved`; both come from saved_options().
void require_same_physics(const std::string& path, const std::string& saved, const std::string& now);

}  // namespace pbmpi::app
