/// The worlds of one rank, stepped by ODE.
#pragma once

#include "ode/objects/engine.h"
#include "ode/solver_resources.h"
#include "stepping/engine/slot_stepper.h"

namespace pbmpi::ode {

class OdeStepper final : public stepping::SlotStepper {
 public:
  OdeStepper(const stepping::StepperSettings& settings, WarningSink warn);
  ~OdeStepper() override;

 private:
  std::unique_ptr<stepping::EngineWorld> make_world(int id, const Slot& slot, std::int64_t step) override;
  void call_engine(int world, std::int64_t step, const std::function<void()>& call) override;
  void advance_world(int id, Slot& slot, int num_steps, core::LapTimer& timer) override;
  void survive(Slot& failed);
  void move_to_fresh_resources();

  Engine engine_;
  MessageLog log_;
  std::unique_ptr<SolverResources> resources_;
};

}  // namespace pbmpi::ode
