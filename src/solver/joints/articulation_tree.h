/// The joints of an articulation as a tree, which can be solved exactly in one pass up and one down.
#pragma once

#include <vector>

#include "solver/layout/articulation.h"

namespace pbmpi::solver {

/// A body in the tree.
struct TreeNode {
  int body = 0;           ///< index in the articulation
  int joint = -1;         ///< the shape's joint that holds it; -1: none does
  int parent = -1;        ///< body at the joint's other end; num_bodies = the static body; -1: none
  bool is_first = false;  ///< is it the joint's first body?
};

/// A spanning tree by breadth-first search, from the static body if a joint is attached to it, else from body
/// 0.
struct ArticulationTree {
  explicit ArticulationTree(const ArticulationShape& shape);

  std::vector<TreeNode> nodes;  ///< [num_bodies] parents before children
  std::vector<int> loops;       ///< joints that are not in the tree, ascending
};

}  // namespace pbmpi::solver
