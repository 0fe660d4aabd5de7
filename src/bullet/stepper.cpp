#include "bullet/stepper.h"

#include <utility>

#include "bullet/bullet_stepper.h"
#include "bullet/world.h"

namespace pbmpi::bullet {

BulletStepper::BulletStepper(const stepping::StepperSettings& settings, std::string warning_prefix)
    : SlotStepper(settings), warning_prefix_(std::move(warning_prefix)) {}

std::unique_ptr<stepping::EngineWorld> BulletStepper::make_world(int, const Slot& slot, std::int64_t step) {
  return std::make_unique<World>(*slot.model, *slot.targets, slot.state, step, settings_, collider_);
}

void BulletStepper::report_loss(int world, std::int64_t step) const {
  stepping::print_loss(warning_prefix_ + "bullet", world, step, "it is not finite");
}

std::unique_ptr<stepping::WorldStepper> make_bullet_stepper(const stepping::StepperSettings& settings,
                                                            const std::string& warning_prefix) {
  return std::make_unique<BulletStepper>(settings, warning_prefix);
}

}  // namespace pbmpi::bullet
