#include "stepping/engine/engine_world.h"

#include <numeric>

namespace pbmpi::stepping {

EngineWorld::EngineWorld(const model::Model& model, MotorTargets& targets, const model::State& state,
                         std::int64_t step, const StepperSettings& settings, std::optional<int> iterations)
    : model_(&model),
      observer_(model),
      targets_(&targets),
      plan_(model),
      settings_(settings),
      state_(state),
      rules_(model, settings.dt_s, iterations, effects::StepRules::World::whole, state_),
      step_(step) {}

std::vector<int> EngineWorld::measured_joints() const {
  const std::span<const int> breakable = rules_.breakable_joints();
  if (!settings_.contacts) return {breakable.begin(), breakable.end()};
  std::vector<int> joints(model_->joints.size());
  std::iota(joints.begin(), joints.end(), 0);
  return joints;
}

}  // namespace pbmpi::stepping
