/// Joints solved exactly, articulation by articulation: the tree propagates in one sweep what sweeps over
/// single joints propagate through a chain only after many.
#pragma once

#include <algorithm>
#include <type_traits>
#include <utility>
#include <vector>

#include "solver/joints/apparent_masses.h"
#include "solver/joints/joint_batches.h"
#include "solver/joints/tree_solver.h"
#include "solver/layout/lane_places.h"

namespace pbmpi::solver {

/// Exact are the articulations that hang or have rotors, and in each step those strained ones that nothing
/// touches: a contact would see only the body that it touches.
template <class T>
class JointTrees {
 public:
  using V = typename T::V;
  using Scalar = typename T::Scalar;
  using Batch = typename JointBatches<T>::Batch;

  /// Takes these shapes, in the order in which they were added to `joints`, which is borrowed. `all`:
  /// whatever touches them.
  JointTrees(const std::vector<LanePlaces::ShapePlace>& shapes, bool all, JointBatches<T>& joints)
      : joints_(joints) {
    for (const LanePlaces::ShapePlace& at : shapes) {
      Shape& shape = shapes_.emplace_back(at.shape);
      shape.first_slot = at.first_slot;
      shape.has_rotors = at.shape.has_rotors();
      shape.always = all || at.shape.hangs() || shape.has_rotors;
      shape.may_be_exact = !at.shape.joints.empty() && (shape.always || at.shape.is_strained);
      shape.exact.assign(static_cast<std::size_t>(at.num_batches), {T::broadcast(0)});
      shape.limited = shape.exact;
      if (!shape.has_rotors) continue;
      shape.in_contact = shape.limited;
      shape.touched.assign(shape.exact.size() * static_cast<std::size_t>(shape.num_bodies),
                           LaneFlags{T::broadcast(0)});
    }
  }

  /// Begins a step, with nothing touched so far.
  void start_step() {
    for (Shape& shape : shapes_) {
      std::ranges::fill(shape.limited, LaneFlags{T::broadcast(0)});
      std::ranges::fill(shape.touched, LaneFlags{T::broadcast(0)});
      std::ranges::fill(shape.in_contact, LaneFlags{T::broadcast(0)});
      if (shape.may_be_exact) std::ranges::fill(shape.exact, LaneFlags{T::broadcast(1)});
    }
  }
  /// A contact touches the body at this place.
  void touch(LanePlace at) {
    for (Shape& shape : shapes_) {
      const int batch = (at.slot - shape.first_slot) / shape.num_bodies;
      if (at.slot < shape.first_slot || batch >= static_cast<int>(shape.exact.size())) continue;
      if (!shape.always) T::set(shape.exact[static_cast<std::size_t>(batch)].flags, at.lane, 0);
      if (!shape.has_rotors) continue;
      T::set(shape.touched[static_cast<std::size_t>(at.slot - shape.first_slot)].flags, at.lane, 1);
      T::set(shape.in_contact[static_cast<std::size_t>(batch)].flags, at.lane, 1);
    }
  }
  /// 1 in the lanes in which a sweep has to solve this joint of a shape's batch, else 0: all that are not
  /// exact, and of exact ones without limits (factor()) the joints that close loops or are driven.
  template <class Rows>
  PBMPI_LANES V swept_lanes(std::size_t shape_index, std::size_t batch, std::size_t joint,
                            const Rows& rows) const {
    const Shape& shape = shapes_[shape_index];
    const V zero = T::broadcast(0);
    const V swept = shape.exact[batch].flags > zero ? bounded_lanes(shape, joint, rows) : T::broadcast(1);
    return shape.limited[batch].flags > zero ? zero : swept;
  }
  /// All, or of those with rotors the articulations that contacts touch in this step.
  enum class Which { all, touched };
  /// 1 in the lanes in which limits are swept and this joint takes part, else 0.
  template <class Rows>
  PBMPI_LANES V limited_lanes(Which which, std::size_t shape_index, std::size_t batch, std::size_t joint,
                              const Rows& rows) const {
    const Shape& shape = shapes_[shape_index];
    if (!shape.belongs_to(which)) return T::broadcast(0);
    return shape.among(which, batch, shape.limited) * bounded_lanes(shape, joint, rows);
  }
  /// Prepares for the current rows, in all active batches, and finds the exact articulations with a joint at
  /// a limit, which the tree cannot hold. `cfm` [s/kg]: the joints' CFM divided by the step.
  void factor(Which which, Scalar cfm, const BodyLanes<T>& bodies);
  /// After factor(): tells contacts with which masses bodies of articulations with rotors answer to them.
  void lend(ApparentMasses<T>& masses, BodyLanes<T>& bodies);
  /// 1 in the lanes in which all joints of a batch are solved exactly, limits and motors aside, else 0.
  V exact_lanes(const Batch& batch) const {
    const Shape& shape = shapes_[batch.shape];
    return shape.may_be_exact && !shape.has_loops ? shape.exact[batch.index].flags : T::broadcast(0);
  }
  /// Solves all rows but those of limits and motors, after a sweep over the joints of swept_lanes().
  void solve(Which which, const JointSolver<T>& solver, BodyLanes<T>& bodies);
  /// solve() where factor() has found limits.
  void solve_limited(Which which, const JointSolver<T>& solver, BodyLanes<T>& bodies);
  bool has_rotors() const {
    return std::ranges::any_of(shapes_, [](const Shape& shape) { return shape.has_rotors; });
  }
  /// Has factor() found limits in an active batch?
  bool has_limited() const { return has_limited_; }

 private:
  /// 1 or 0 lane by lane.
  struct alignas(sizeof(V)) LaneFlags {
    V flags;
  };
  struct Shape {
    explicit Shape(const ArticulationShape& shape)
        : num_bodies(shape.num_bodies), num_joints(shape.joints.size()), in_loop(num_joints, 0) {
      ArticulationTree tree(shape);
      for (const int joint : tree.loops) in_loop[static_cast<std::size_t>(joint)] = 1;
      has_loops = !tree.loops.empty();
      nodes = std::move(tree.nodes);
    }
    int num_bodies, first_slot = 0;
    std::size_t num_joints;
    bool always = false;  ///< exact, whatever touches it?
    bool may_be_exact = false, has_loops = false, has_rotors = false;
    std::vector<TreeNode> nodes;
    std::vector<char> in_loop;       ///< [num_joints]
    std::vector<LaneFlags> exact;    ///< [num_batches] in this step
    std::vector<LaneFlags> limited;  ///< [num_batches] exact, and a joint is at a limit
    // With rotors:
    std::vector<LaneFlags> touched;     ///< [num_batches * num_bodies] the body is in contact in this step
    std::vector<LaneFlags> in_contact;  ///< [num_batches] any of the bodies is
    std::vector<TreeSolver<T>> trees;   ///< [num_batches], empty as long as no lane was exact

    bool belongs_to(Which which) const { return which == Which::all || has_rotors; }
    /// The lanes of these, of belongs_to(which).
    V among(Which which, std::size_t batch, const std::vector<LaneFlags>& lanes) const {
      return which == Which::all ? lanes[batch].flags : lanes[batch].flags * in_contact[batch].flags;
    }
    int parent_of(const TreeNode& node) const { return node.parent == num_bodies ? -1 : node.parent; }
  };

  /// 1 in the lanes in which the tree leaves a joint to sweeps: it closes a loop, is at a limit or driven.
  template <class Rows>
  PBMPI_LANES static V bounded_lanes(const Shape& shape, std::size_t joint, const Rows& rows) {
    const V zero = T::broadcast(0), one = T::broadcast(1);
    V bounded = shape.in_loop[joint] != 0 ? one : zero;
    for_each_control(rows, [&](const auto& control, std::size_t axis) {
      if (rows.control_on[axis]) bounded = control.low < control.high ? one : bounded;
    });
    return bounded;
  }
  /// Calls visit(shape, tree, batch) for each active batch with an exact lane.
  template <class Visit>
  void for_each_tree(Visit visit) {
    joints_.for_each_active_batch([&](const Batch& batch) {
      Shape& shape = shapes_[batch.shape];
      if (!T::any(shape.exact[batch.index].flags)) return;
      if (shape.trees.empty()) shape.trees.assign(shape.exact.size(), TreeSolver<T>(shape.num_bodies));
      visit(shape, shape.trees[batch.index], batch);
    });
  }
  /// Calls visit(rows, number of rows to be solved exactly, as a constant).
  template <class Visit>
  void with_rows(const Batch& batch, const Shape& shape, int joint, Visit visit) {
    const std::size_t index = batch.index * shape.num_joints + static_cast<std::size_t>(joint);
    joints_.change_rows(batch.shape, index, [&](auto& rows) {
      constexpr RowCounts counts = std::remove_reference_t<decltype(rows)>::counts;
      if (rows.has_rotors) {
        visit(rows, std::integral_constant<int, counts.all()>{});
      } else {
        visit(rows, std::integral_constant<int, counts.held()>{});
      }
    });
  }
  void factor_tree(Scalar cfm, Shape& shape, TreeSolver<T>& tree, const Batch& batch,
                   const BodyLanes<T>& bodies);
  /// 1 in the lanes that are exact and have a joint at a limit, else 0.
  V find_limited(const Shape& shape, const Batch& batch);
  /// `where`: 1 in the lanes that take the solution, else 0.
  void solve_tree(const JointSolver<T>& solver, const Shape& shape, TreeSolver<T>& tree, const Batch& batch,
                  const V& where, BodyLanes<T>& bodies);

  JointBatches<T>& joints_;
  std::vector<Shape> shapes_;
  bool has_limited_ = false;
};

template <class T>
void JointTrees<T>::factor(Which which, Scalar cfm, const BodyLanes<T>& bodies) {
  has_limited_ = false;
  for_each_tree([&](Shape& shape, TreeSolver<T>& tree, const Batch& batch) {
    if (shape.belongs_to(which)) factor_tree(cfm, shape, tree, batch, bodies);
    has_limited_ = has_limited_ || T::any(shape.limited[batch.index].flags);
  });
}

template <class T>
void JointTrees<T>::factor_tree(Scalar cfm, Shape& shape, TreeSolver<T>& tree, const Batch& batch,
                                const BodyLanes<T>& bodies) {
  shape.limited[batch.index].flags = find_limited(shape, batch);
  for (const TreeNode& node : shape.nodes)
    tree.start_body(node.body, bodies.bodies[batch.first_slot + node.body]);
  for (auto node = shape.nodes.rbegin(); node != shape.nodes.rend(); ++node) {
    if (node->joint < 0) {
      tree.close_root(node->body);
    } else {
      with_rows(batch, shape, node->joint, [&](const auto& rows, auto count) {
        tree.template eliminate<count.value>(node->body, shape.parent_of(*node), node->is_first, cfm, rows);
      });
    }
  }
}

template <class T>
void JointTrees<T>::lend(ApparentMasses<T>& masses, BodyLanes<T>& bodies) {
  for_each_tree([&](Shape& shape, TreeSolver<T>& tree, const Batch& batch) {
    if (!shape.has_rotors) return;
    const LaneFlags* touched = &shape.touched[batch.index * static_cast<std::size_t>(shape.num_bodies)];
    V num_touched = T::broadcast(0);
    for (int body = 0; body < shape.num_bodies; ++body) num_touched += touched[body].flags;
    if (!T::any(num_touched)) return;
    for (const TreeNode& node : shape.nodes) {
      if (node.joint < 0) {
        tree.answer_root(node.body);
      } else {
        with_rows(batch, shape, node.joint, [&](const auto&, auto count) {
          tree.template answer<count.value>(node.body, shape.parent_of(node), node.is_first);
        });
      }
    }
    for (int body = 0; body < shape.num_bodies; ++body) {
      if (T::any(touched[body].flags))
        masses.lend(batch.first_slot + body, tree.answer_of(body), touched[body].flags, num_touched, bodies);
    }
  });
}

template <class T>
void JointTrees<T>::solve(Which which, const JointSolver<T>& solver, BodyLanes<T>& bodies) {
  for_each_tree([&](const Shape& shape, TreeSolver<T>& tree, const Batch& batch) {
    if (!shape.belongs_to(which)) return;
    const V where = shape.among(which, batch.index, shape.exact);
    if (T::any(where)) solve_tree(solver, shape, tree, batch, where, bodies);
  });
}

template <class T>
void JointTrees<T>::solve_limited(Which which, const JointSolver<T>& solver, BodyLanes<T>& bodies) {
  for_each_tree([&](const Shape& shape, TreeSolver<T>& tree, const Batch& batch) {
    if (!shape.belongs_to(which)) return;
    const V limited = shape.among(which, batch.index, shape.limited);
    if (T::any(limited)) solve_tree(solver, shape, tree, batch, limited, bodies);
  });
}

template <class T>
typename T::V JointTrees<T>::find_limited(const Shape& shape, const Batch& batch) {
  const V zero = T::broadcast(0);
  V limited = zero;
  for (std::size_t joint = 0; joint < shape.num_joints; ++joint) {
    joints_.change_rows(batch.shape, batch.index * shape.num_joints + joint, [&](const auto& rows) {
      for_each_control(rows, [&](const auto& control, std::size_t axis) {
        if (rows.control_on[axis]) limited = limited + control.at_limit;
      });
    });
  }
  return limited > zero ? shape.exact[batch.index].flags : zero;
}

template <class T>
void JointTrees<T>::solve_tree(const JointSolver<T>& solver, const Shape& shape, TreeSolver<T>& tree,
                               const Batch& batch, const V& where, BodyLanes<T>& bodies) {
  tree.start_solve(where);
  for (auto node = shape.nodes.rbegin(); node != shape.nodes.rend(); ++node) {
    if (node->joint < 0) continue;
    with_rows(batch, shape, node->joint, [&](auto& rows, auto count) {
      tree.template up<count.value>(node->body, shape.parent_of(*node), node->is_first, solver, bodies, rows);
    });
  }
  for (const TreeNode& node : shape.nodes) {
    if (node.joint < 0) {
      tree.root(node.body, bodies.twists[batch.first_slot + node.body]);
    } else {
      with_rows(batch, shape, node.joint, [&](auto& rows, auto count) {
        tree.template down<count.value>(node.body, shape.parent_of(node), node.is_first, solver, bodies,
                                        rows);
      });
    }
  }
}

}  // namespace pbmpi::solver
