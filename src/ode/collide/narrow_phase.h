/// ODE's dCollide as the narrow phase of another stepper.
#pragma once

#include <memory>

#include "model/contact.h"

namespace pbmpi::ode {

/// Contacts by dCollide with the lower geom first, at most model.contact_law.max_per_pair per pair. `model`
/// is borrowed. Several narrow phases may collide at the same time, each in one thread.
std::unique_ptr<model::NarrowPhase> make_narrow_phase(const model::Model& model);

}  // namespace pbmpi::ode
