#include "effects/breakage.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace pbmpi::effects {
namespace {

constexpr std::int64_t never = std::numeric_limits<std::int64_t>::max();

}  // namespace

core::Vec3 offset_of_second(const model::Model& model, const model::Joint& joint) {
  if (joint.body_b == model::no_body) return core::Vec3::Zero();
  const core::Pose& a = model.bodies[joint.body_a].pose;
  return a.orientation.to_eigen().conjugate() * (model.bodies[joint.body_b].pose.position - a.position);
}

bool breaks(const model::Joint& joint, const Reaction& reaction) {
  return (joint.break_force > 0 && reaction.force_n > joint.break_force) ||
         (joint.break_torque > 0 && reaction.torque_nm > joint.break_torque);
}

Breakage::Breakage(const model::Model& model) : model_(&model) {
  std::vector<std::int64_t> released_at(model.joints.size(), never);
  for (const model::Event& event : model.events) {
    if (event.kind == model::EventKind::release)
      released_at[event.joint] = std::min(released_at[event.joint], event.step);
  }
  for (std::size_t joint = 0; joint < model.joints.size(); ++joint) {
    if (model.joints[joint].breakable() || released_at[joint] != never)
      joints_.push_back(static_cast<int>(joint));
  }
  if (std::ranges::any_of(released_at, [](std::int64_t step) { return step != never; }))
    released_at_ = std::move(released_at);
}

void Breakage::start(model::State& state) const {
  if (state.broken_in.empty()) state.broken_in.assign(model_->joints.size(), model::unbroken);
}

bool Breakage::break_overloaded_joints(std::int64_t step, std::span<const int> joints,
                                       const GetReaction& reaction, model::State& state) const {
  bool any = false;
  for (const int joint : joints) {
    const model::Joint& one = model_->joints[joint];
    if (state.is_broken(static_cast<std::size_t>(joint))) continue;
    if (!state.rest.empty() && state.rest[one.body_a].asleep()) continue;
    if (!is_released(joint, step + 1) && !(one.breakable() && breaks(one, reaction(joint)))) continue;
    state.broken_in[joint] = static_cast<std::int32_t>(step);
    any = true;
  }
  return any;
}

}  // namespace pbmpi::effects
