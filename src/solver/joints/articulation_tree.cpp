#include "solver/joints/articulation_tree.h"

namespace pbmpi::solver {

ArticulationTree::ArticulationTree(const ArticulationShape& shape) {
  std::vector<char> reached(static_cast<std::size_t>(shape.num_bodies) + 1, 0);
  std::vector<char> in_tree(shape.joints.size(), 0);
  std::vector<int> queue;
  const auto reach = [&](const TreeNode& node) {
    reached[static_cast<std::size_t>(node.body)] = 1;
    queue.push_back(node.body);
    if (node.body != shape.num_bodies) nodes.push_back(node);
  };
  reach({.body = shape.hangs() ? shape.num_bodies : 0});
  for (std::size_t next = 0; next < queue.size(); ++next) {
    const int body = queue[next];
    for (std::size_t joint = 0; joint < shape.joints.size(); ++joint) {
      const JointLink& link = shape.joints[joint];
      if (link.body_a != body && link.body_b != body) continue;
      const int other = link.body_a == body ? link.body_b : link.body_a;
      if (reached[static_cast<std::size_t>(other)] != 0) continue;
      in_tree[joint] = 1;
      reach({other, static_cast<int>(joint), body, link.body_a == other});
    }
  }
  for (std::size_t joint = 0; joint < in_tree.size(); ++joint) {
    if (in_tree[joint] == 0) loops.push_back(static_cast<int>(joint));
  }
}

}  // namespace pbmpi::solver
