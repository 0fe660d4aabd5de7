/// The worlds of one rank, stepped by Bullet.
#pragma once

#include <string>

#include "bullet/collide/collider.h"
#include "stepping/engine/slot_stepper.h"

namespace pbmpi::bullet {

class BulletStepper final : public stepping::SlotStepper {
 public:
  BulletStepper(const stepping::StepperSettings& settings, std::string warning_prefix);
  ~BulletStepper() override { end_worlds(); }

 private:
  std::unique_ptr<stepping::EngineWorld> make_world(int id, const Slot& slot, std::int64_t step) override;
  void report_loss(int world, std::int64_t step) const override;

  std::string warning_prefix_;
  Collider collider_;
};

}  // namespace pbmpi::bullet
