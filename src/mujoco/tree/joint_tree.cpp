#include "mujoco/tree/joint_tree.h"

#include <algorithm>

#include "model/islands.h"
#include "model/joint_traits.h"

namespace pbmpi::mujoco {
namespace {

/// Joints of the lowest class enter the tree first.
int class_of(const model::Joint& joint, bool has_controls) {
  return has_controls ? 0 : static_cast<int>(closing_of(joint.kind));
}

/// The joints that hold, ordered by preference for the tree.
std::vector<int> joints_in_turn(const model::Model& model, std::span<const std::int32_t> broken_in) {
  const std::vector<bool> controls = joints_with_controls(model);
  std::vector<int> joints;
  for (int joint = 0; joint < model.num_joints(); ++joint) {
    if (broken_in.empty() || broken_in[joint] == model::unbroken) joints.push_back(joint);
  }
  std::ranges::stable_sort(joints, {},
                           [&](int joint) { return class_of(model.joints[joint], controls[joint]); });
  return joints;
}

/// Attaches all bodies that joints of the tree reach from `start` to their predecessors.
class Walk {
 public:
  explicit Walk(const model::Model& model)
      : model_(&model), world_(model.num_bodies()), joints_(model.bodies.size() + 1) {
    tree_.holds.resize(model.bodies.size());
    seen_.assign(model.bodies.size() + 1, false);
  }

  void add(int joint) {
    joints_[node_of(model_->joints[joint].body_a)].push_back(joint);
    joints_[node_of(model_->joints[joint].body_b)].push_back(joint);
  }

  JointTree finish(std::vector<int> closing) {
    for (auto& joints : joints_) std::ranges::sort(joints);
    spread(world_);
    for (int body = 0; body < world_; ++body) {
      if (!seen_[body]) spread(body);
    }
    std::ranges::sort(closing);
    tree_.closing = std::move(closing);
    return std::move(tree_);
  }

 private:
  int node_of(int body) const { return body == model::no_body ? world_ : body; }

  void spread(int start) {
    std::vector<int> queue{start};
    seen_[start] = true;
    for (std::size_t next = 0; next < queue.size(); ++next) {
      const int node = queue[next];
      if (node != world_) tree_.order.push_back(node);
      for (const int joint : joints_[node]) {
        const model::Joint& by = model_->joints[joint];
        const int other = node_of(by.body_a) == node ? node_of(by.body_b) : node_of(by.body_a);
        if (seen_[other]) continue;
        seen_[other] = true;
        tree_.holds[other] = {joint, node == world_ ? model::no_body : node};
        queue.push_back(other);
      }
    }
  }

  const model::Model* model_;
  int world_;                             ///< node of the world
  std::vector<std::vector<int>> joints_;  ///< [nodes] joints of the tree
  std::vector<bool> seen_;                ///< [nodes]
  JointTree tree_;
};

}  // namespace

Closing closing_of(model::JointKind kind) {
  const model::JointTraits& traits = model::traits_of(kind);
  if (traits.place == model::HeldPlace::offset) return Closing::weld;
  if (traits.place != model::HeldPlace::anchor) return Closing::none;
  if (traits.turn == model::HeldTurn::nothing) return Closing::point;
  return traits.turn == model::HeldTurn::axis ? Closing::two_points : Closing::none;
}

std::vector<bool> joints_with_controls(const model::Model& model) {
  std::vector<bool> controls(model.joints.size(), false);
  for (std::size_t i = 0; i < model.joints.size(); ++i) {
    const model::Joint& joint = model.joints[i];
    controls[i] = joint.breakable() || std::ranges::any_of(joint.limits, &model::AxisLimit::active) ||
                  std::ranges::any_of(joint.motors, &model::AxisMotor::active);
  }
  for (const model::Event& event : model.events) {
    if (event.kind == model::EventKind::motor || event.kind == model::EventKind::steer)
      controls[event.joint] = true;
  }
  return controls;
}

JointTree make_joint_tree(const model::Model& model, std::span<const std::int32_t> broken_in) {
  const int world = model.num_bodies();
  model::DisjointSets sets(world + 1);
  Walk walk(model);
  std::vector<int> closing;
  for (const int joint : joints_in_turn(model, broken_in)) {
    const int a = model.joints[joint].body_a, b = model.joints[joint].body_b;
    const int node_b = b == model::no_body ? world : b;
    if (sets.find(a) == sets.find(node_b)) {
      closing.push_back(joint);
      continue;
    }
    sets.unite(a, node_b);
    walk.add(joint);
  }
  return walk.finish(std::move(closing));
}

}  // namespace pbmpi::mujoco
