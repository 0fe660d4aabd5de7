/// The worlds of one rank, stepped by MuJoCo.
#pragma once

#include <string>

#include "stepping/engine/slot_stepper.h"

namespace pbmpi::mujoco {

class MujocoStepper final : public stepping::SlotStepper {
 public:
  MujocoStepper(const stepping::StepperSettings& settings, std::string warning_prefix);

 private:
  std::unique_ptr<stepping::EngineWorld> make_world(int id, const Slot& slot, std::int64_t step) override;
  void call_engine(int world, std::int64_t step, const std::function<void()>& call) override;
  void advance_world(int id, Slot& slot, int num_steps, core::LapTimer& timer) override;
  void report_loss(int world, std::int64_t step) const override;

  std::string warning_prefix_;
};

}  // namespace pbmpi::mujoco
