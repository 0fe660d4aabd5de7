#include "model/touch_rule.h"

#include <algorithm>
#include <numeric>

#include "model/state.h"

namespace pbmpi::model {

TouchRule::TouchRule(const Model& model, std::span<const std::int32_t> broken_in)
    : model_(&model), first_(model.bodies.size() + 1, 0) {
  const auto for_each_pair = [&](const auto& visit) {
    for (std::size_t i = 0; i < model.joints.size(); ++i) {
      const Joint& joint = model.joints[i];
      if (joint.body_b == no_body || (!broken_in.empty() && broken_in[i] != unbroken)) continue;
      visit(static_cast<std::size_t>(joint.body_a), joint.body_b);
      visit(static_cast<std::size_t>(joint.body_b), joint.body_a);
    }
  };
  for_each_pair([this](std::size_t body, int) { ++first_[body + 1]; });
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  joined_.resize(static_cast<std::size_t>(first_.back()));
  std::vector<int> next(first_.begin(), first_.end() - 1);
  for_each_pair(
      [&](std::size_t body, int other) { joined_[static_cast<std::size_t>(next[body]++)] = other; });
  for (std::size_t body = 0; body < next.size(); ++body)
    std::sort(joined_.begin() + first_[body], joined_.begin() + first_[body + 1]);
}

bool TouchRule::may_touch(int first, int second) const {
  const Geom& a = model_->geoms[static_cast<std::size_t>(first)];
  const Geom& b = model_->geoms[static_cast<std::size_t>(second)];
  if (a.body == b.body) return false;  // geoms of one body, or both static
  if (a.shape == Shape::plane && b.shape == Shape::plane) return false;
  if (a.actor == b.actor && !model_->actors[static_cast<std::size_t>(a.actor)].self_collision) return false;
  if (a.body == no_body || b.body == no_body) return true;
  const auto body = static_cast<std::size_t>(a.body);
  return !std::binary_search(joined_.begin() + first_[body], joined_.begin() + first_[body + 1], b.body);
}

}  // namespace pbmpi::model
