/// Joints solved exactly, articulation by articulation: the tree propagates in one sweep what sweeps over
/// single joints propagate through a chain only after many.
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "solver/joints/joint_batches.h"
#include "solver/joints/tree_solver.h"
#include "solver/layout/lane_places.h"

namespace pbmpi::solver {

template <class T>
class JointTrees {
 public:
  using Scalar = typename T::Scalar;
  using Batch = typename JointBatches<T>::Batch;

  /// Takes these shapes, in the order in which they were added to `joints`, which is borrowed.
  /// `only_hanging`: solves only the shapes that hang.
  JointTrees(const std::vector<LanePlaces::ShapePlace>& shapes, bool only_hanging, JointBatches<T>& joints)
      : joints_(joints) {
    for (const LanePlaces::ShapePlace& at : shapes) {
      Shape& shape = shapes_.emplace_back(at.shape);
      if (!at.shape.joints.empty() && (at.shape.hangs() || !only_hanging))
        shape.trees.assign(static_cast<std::size_t>(at.num_batches), TreeSolver<T>(at.shape.num_bodies));
    }
  }

  bool solves_any() const {
    return std::ranges::any_of(shapes_, [](const Shape& shape) { return !shape.trees.empty(); });
  }
  bool solves(std::size_t shape) const { return !shapes_[shape].trees.empty(); }
  /// Prepares for the current rows, in all active batches. `cfm` [s/kg]: the joints' CFM divided by the step.
  void factor(Scalar cfm, const BodyLanes<T>& bodies);
  /// Solves limits, motors and the joints that close loops by a sweep, then all other rows exactly.
  void solve(const JointSolver<T>& solver, BodyLanes<T>& bodies);

 private:
  struct Shape {
    explicit Shape(const ArticulationShape& shape)
        : num_bodies(shape.num_bodies), num_joints(shape.joints.size()), in_loop(num_joints, 0) {
      ArticulationTree tree(shape);
      for (const int joint : tree.loops) in_loop[static_cast<std::size_t>(joint)] = 1;
      nodes = std::move(tree.nodes);
    }
    int num_bodies;
    std::size_t num_joints;
    std::vector<TreeNode> nodes;
    std::vector<char> in_loop;         ///< [num_joints]
    std::vector<TreeSolver<T>> trees;  ///< [num_batches], empty if the shape is not solved here

    int parent_of(const TreeNode& node) const { return node.parent == num_bodies ? -1 : node.parent; }
  };

  /// Calls visit(shape, tree, batch) for each active batch that is solved here.
  template <class Visit>
  void for_each_tree(Visit visit) {
    joints_.for_each_active_batch([&](const Batch& batch) {
      Shape& shape = shapes_[batch.shape];
      if (!shape.trees.empty()) visit(shape, shape.trees[batch.index], batch);
    });
  }
  template <class Visit>
  void with_rows(const Batch& batch, const Shape& shape, std::size_t joint, Visit visit) {
    joints_.change_rows(batch.shape, batch.index * shape.num_joints + joint, visit);
  }
  void sweep_others(const JointSolver<T>& solver, const Shape& shape, const Batch& batch,
                    BodyLanes<T>& bodies);
  void solve_tree(Scalar bias, const Shape& shape, TreeSolver<T>& tree, const Batch& batch,
                  BodyLanes<T>& bodies);

  JointBatches<T>& joints_;
  std::vector<Shape> shapes_;
};

template <class T>
void JointTrees<T>::factor(Scalar cfm, const BodyLanes<T>& bodies) {
  for_each_tree([&](const Shape& shape, TreeSolver<T>& tree, const Batch& batch) {
    for (const TreeNode& node : shape.nodes)
      tree.start_body(node.body, bodies.bodies[batch.first_slot + node.body]);
    for (auto node = shape.nodes.rbegin(); node != shape.nodes.rend(); ++node) {
      if (node->joint < 0) {
        tree.close_root(node->body);
      } else {
        with_rows(batch, shape, static_cast<std::size_t>(node->joint), [&](const auto& rows) {
          tree.eliminate(node->body, shape.parent_of(*node), node->is_first, cfm, rows);
        });
      }
    }
  });
}

template <class T>
void JointTrees<T>::sweep_others(const JointSolver<T>& solver, const Shape& shape, const Batch& batch,
                                 BodyLanes<T>& bodies) {
  for (const std::size_t joint : joints_.order(batch.shape)) {
    with_rows(batch, shape, joint, [&](auto& rows) {
      if (shape.in_loop[joint]) {
        solver.template solve<true>(rows, bodies);
      } else {
        solver.solve_controls(rows, bodies);
      }
    });
  }
}

template <class T>
void JointTrees<T>::solve(const JointSolver<T>& solver, BodyLanes<T>& bodies) {
  for_each_tree([&](const Shape& shape, TreeSolver<T>& tree, const Batch& batch) {
    sweep_others(solver, shape, batch, bodies);
    solve_tree(solver.exact_bias(), shape, tree, batch, bodies);
  });
}

template <class T>
void JointTrees<T>::solve_tree(Scalar bias, const Shape& shape, TreeSolver<T>& tree, const Batch& batch,
                               BodyLanes<T>& bodies) {
  tree.start_solve();
  for (auto node = shape.nodes.rbegin(); node != shape.nodes.rend(); ++node) {
    if (node->joint < 0) continue;
    with_rows(batch, shape, static_cast<std::size_t>(node->joint), [&](auto& rows) {
      tree.up(node->body, shape.parent_of(*node), node->is_first, bias, bodies, rows);
    });
  }
  for (const TreeNode& node : shape.nodes) {
    if (node.joint < 0) {
      tree.root(node.body, bodies.twists[batch.first_slot + node.body]);
    } else {
      with_rows(batch, shape, static_cast<std::size_t>(node.joint), [&](auto& rows) {
        tree.down(node.body, shape.parent_of(node), node.is_first, bodies, rows);
      });
    }
  }
}

}  // namespace pbmpi::solver
