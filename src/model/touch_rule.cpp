#include "model/touch_rule.h"

#include <algorithm>

#include "model/state.h"

namespace pbmpi::model {

TouchRule::TouchRule(const Model& model, std::span<const std::int32_t> broken_in)
    : model_(&model), joined_(model.bodies.size()) {
  for (std::size_t i = 0; i < model.joints.size(); ++i) {
    const Joint& joint = model.joints[i];
    if (joint.body_b == no_body || (!broken_in.empty() && broken_in[i] != unbroken)) continue;
    joined_[static_cast<std::size_t>(joint.body_a)].push_back(joint.body_b);
    joined_[static_cast<std::size_t>(joint.body_b)].push_back(joint.body_a);
  }
  for (auto& bodies : joined_) std::sort(bodies.begin(), bodies.end());
}

bool TouchRule::may_touch(int first, int second) const {
  const Geom& a = model_->geoms[static_cast<std::size_t>(first)];
  const Geom& b = model_->geoms[static_cast<std::size_t>(second)];
  if (a.body == b.body) return false;  // geoms of one body, or both static
  if (a.shape == Shape::plane && b.shape == Shape::plane) return false;
  if (a.actor == b.actor && !model_->actors[static_cast<std::size_t>(a.actor)].self_collision) return false;
  if (a.body == no_body || b.body == no_body) return true;
  const std::vector<int>& joined = joined_[static_cast<std::size_t>(a.body)];
  return !std::binary_search(joined.begin(), joined.end(), b.body);
}

}  // namespace pbmpi::model
