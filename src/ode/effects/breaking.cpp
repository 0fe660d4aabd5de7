#include "ode/effects/breaking.h"

#include <algorithm>

namespace pbmpi::ode {

using model::Joint;
using model::JointKind;
using model::Vec3;

namespace {

Vec3 to_world(dBodyID body, const Vec3& local) {
  dVector3 turned;
  dBodyVectorToWorld(body, local.x(), local.y(), local.z(), turned);
  return Vec3(turned);
}

}  // namespace

Breaking::Breaking(const model::Model& model, const std::vector<dJointID>& joints, bool measures)
    : model_(&model), joints_(joints), rule_(model), measures_(measures) {
  if (!measures) return;
  rule_.start(state_);
  watched_.resize(rule_.joints().size());
  for (std::size_t i = 0; i < watched_.size(); ++i) {
    watched_[i].joint = rule_.joints()[i];
    dJointSetFeedback(joints_[watched_[i].joint], &watched_[i].feedback);
  }
}

bool Breaking::start(const std::vector<std::int32_t>& broken_in) {
  const std::vector<std::int32_t> before = std::move(state_.broken_in);
  state_.broken_in = broken_in;
  if (measures_) rule_.start(state_);
  const auto is_broken = [](std::int32_t step) { return step != model::unbroken; };
  const bool same = std::equal(before.begin(), before.end(), state_.broken_in.begin(), state_.broken_in.end(),
                               [&](std::int32_t a, std::int32_t b) { return is_broken(a) == is_broken(b); });
  if (same) return false;
  show();
  return true;
}

void Breaking::show() {
  for (std::size_t joint = 0; joint < joints_.size(); ++joint)
    state_.is_broken(joint) ? dJointDisable(joints_[joint]) : dJointEnable(joints_[joint]);
}

Vec3 Breaking::place_from_centre(const Joint& joint, dJointID id) const {
  const dBodyID a = dJointGetBody(id, 0), b = dJointGetBody(id, 1);
  if (joint.kind != JointKind::slider) return to_world(a, joint.anchor_a);
  return b == nullptr ? Vec3::Zero() : Vec3(0.5 * (Vec3(dBodyGetPosition(b)) - Vec3(dBodyGetPosition(a))));
}

void Breaking::note_places() {
  for (Watched& one : watched_)
    one.from_centre = place_from_centre(model_->joints[one.joint], joints_[one.joint]);
}

bool Breaking::strain(std::int64_t step, std::span<const model::Rest> rest) {
  if (watched_.empty()) return false;
  for (Watched& one : watched_) {
    const Joint& joint = model_->joints[one.joint];
    if (joint.kind == JointKind::fixed) one.from_centre = place_from_centre(joint, joints_[one.joint]);
  }
  state_.rest.assign(rest.begin(), rest.end());
  const auto reaction = [&](int joint) -> effects::Reaction {
    const auto found = std::lower_bound(watched_.begin(), watched_.end(), joint,
                                        [](const Watched& one, int wanted) { return one.joint < wanted; });
    const Vec3 force(found->feedback.f1), torque(found->feedback.t1);
    return {force.norm(), (torque - found->from_centre.cross(force)).norm()};
  };
  const bool broke = rule_.strain(step, rule_.joints(), reaction, state_);
  if (broke) show();
  return broke;
}

}  // namespace pbmpi::ode
