/// The joints of an articulation as a tree, which can be solved exactly in one pass up and one down.
#pragma once

#include <vector>

#include "solver/layout/articulation.h"

namespace pbmpi::solver {

/// A body as it hangs from the tree.
struct TreeNode {
  int body = 0;           ///< of the articulation
  int joint = -1;         ///< that holds it, of the shape; -1: nothing does
  int parent = -1;        ///< at the joint's other end; num_bodies = the static body; -1: none
  bool is_first = false;  ///< is it the joint's first body?
};

/// A spanning tree by breadth first search, from the static body if a joint is on it, else from body 0.
struct ArticulationTree {
  explicit ArticulationTree(const ArticulationShape& shape);

  std::vector<TreeNode> nodes;  ///< [num_bodies] parents before children
  std::vector<int> loops;       ///< joints that are not in the tree, ascending
};

}  // namespace pbmpi::solver
