#include "stepping/stepper.h"

#include "core/error.h"

namespace pbmpi::stepping {

void WorldStepper::set_motor_velocity(int, int, int, double) {
  throw core::InputError("this stepper has no motors that can be aimed");
}

void WorldStepper::set_load(int, int, const BodyLoad&) {
  throw core::InputError("this stepper takes no forces from outside; take the stepper sor");
}

}  // namespace pbmpi::stepping
