#include <string>
#include <utility>

#include "core/error.h"
#include "mujoco/mujoco_stepper.h"
#include "mujoco/world.h"
#include "stepping/engine/slot_stepper.h"

namespace pbmpi::mujoco {
namespace {

/// The worlds of one rank, stepped by MuJoCo.
class MujocoStepper final : public stepping::SlotStepper {
 public:
  MujocoStepper(const stepping::StepperSettings& settings, std::string warning_prefix)
      : SlotStepper(settings), warning_prefix_(std::move(warning_prefix)) {}

 private:
  std::unique_ptr<stepping::EngineWorld> make_world(int id, const Slot& slot, std::int64_t step) override;
  void call_engine(int world, std::int64_t step, const std::function<void()>& call) override;
  void advance_world(int id, Slot& slot, int num_steps, core::LapTimer& timer) override;
  void report_loss(int world, std::int64_t step) const override;

  std::string warning_prefix_;
};

}  // namespace

std::unique_ptr<stepping::EngineWorld> MujocoStepper::make_world(int, const Slot& slot, std::int64_t step) {
  return std::make_unique<World>(*slot.model, *slot.targets, slot.state, step, settings_);
}

void MujocoStepper::call_engine(int, std::int64_t, const std::function<void()>& call) {
  const MessageScope scope;
  call();
}

/// A world that MuJoCo would refuse at its start is an error of the run once it is under way.
void MujocoStepper::advance_world(int id, Slot& slot, int num_steps, core::LapTimer& timer) {
  const auto place = [&] {
    return " (world " + std::to_string(id) + ", step " + std::to_string(slot.world->step()) + ")";
  };
  try {
    SlotStepper::advance_world(id, slot, num_steps, timer);
  } catch (const core::InputError& error) {
    throw core::RunError(error.what() + place());
  } catch (const EngineError& error) {
    throw core::RunError(error.what() + place());
  }
}

void MujocoStepper::report_loss(int world, std::int64_t step) const {
  stepping::print_loss(warning_prefix_ + "mujoco", world, step, "its accelerations are not finite");
}

std::unique_ptr<stepping::WorldStepper> make_mujoco_stepper(const stepping::StepperSettings& settings,
                                                            const std::string& warning_prefix) {
  return std::make_unique<MujocoStepper>(settings, warning_prefix);
}

}  // namespace pbmpi::mujoco
