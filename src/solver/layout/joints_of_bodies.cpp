#include "solver/layout/joints_of_bodies.h"

namespace pbmpi::solver {

JointsOfBodies::JointsOfBodies(const model::Model& model)
    : first(model.bodies.size() + 1, 0), joints(model.joints.size()) {
  for (const model::Joint& joint : model.joints) ++first[static_cast<std::size_t>(joint.body_a) + 1];
  for (std::size_t body = 1; body < first.size(); ++body) first[body] += first[body - 1];
  std::vector<int> next(first.begin(), first.end() - 1);
  for (std::size_t joint = 0; joint < joints.size(); ++joint) {
    const auto body = static_cast<std::size_t>(model.joints[joint].body_a);
    joints[static_cast<std::size_t>(next[body]++)] = static_cast<int>(joint);
  }
}

}  // namespace pbmpi::solver
