#include <string>
#include <utility>

#include "bullet/bullet_stepper.h"
#include "bullet/collide/collider.h"
#include "bullet/world.h"
#include "stepping/engine/slot_stepper.h"

namespace pbmpi::bullet {
namespace {

/// The worlds of one rank, stepped by Bullet.
class BulletStepper final : public stepping::SlotStepper {
 public:
  BulletStepper(const stepping::StepperSettings& settings, std::string warning_prefix)
      : SlotStepper(settings), warning_prefix_(std::move(warning_prefix)) {}
  ~BulletStepper() override { end_worlds(); }

 private:
  std::unique_ptr<stepping::EngineWorld> make_world(int id, const Slot& slot, std::int64_t step) override;
  void report_loss(int world, std::int64_t step) const override;

  std::string warning_prefix_;
  Collider collider_;
};

}  // namespace

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
