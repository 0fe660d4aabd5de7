/// Solves the joints of a tree of bodies exactly: elimination from the leaves to the root and back, which
/// takes time linear in the number of joints (D. Baraff, "Linear-Time Dynamics using Lagrange Multipliers",
/// SIGGRAPH 1996; the recursion is that of R. Featherstone's articulated-body inertia).
#pragma once

#include <array>
#include <vector>

#include "solver/joints/articulation_tree.h"
#include "solver/joints/joint_jacobian.h"
#include "solver/lanes/symmetric_factor.h"

namespace pbmpi::solver {

/// Solves one batch. The bodies' changes of twist u and the rows' impulses p satisfy
///   M u = J^T p,  J u + C p = r,  r = rhs - J v - C p_before.
/// With its subtree eliminated a body c below a joint to its parent has the mass M_c' and the force f_c; the
/// joint has S = J_c M_c'^-1 J_c^T + C, and adds J_p^T S^-1 J_p to the parent's mass.
template <class T>
class TreeSolver {
 public:
  using V = typename T::V;
  using Scalar = typename T::Scalar;

  explicit TreeSolver(int num_bodies) : nodes_(static_cast<std::size_t>(num_bodies)) {}

  /// Body by body, children before parents.
  void start_body(int node, const BodyLane<V>& body);
  template <model::JointKind kind>
  void eliminate(int node, int parent, bool is_first, Scalar cfm, const JointRows<T, kind>& rows);
  void close_root(int node) {
    Node& own = nodes_[static_cast<std::size_t>(node)];
    own.mass.factor(own.sum);
  }

  // A solve: start_solve(); up() children before parents; root(); down() parents before children. `bias`:
  // scales the right-hand sides; 0 leaves position errors as they are.
  void start_solve() {
    for (Node& node : nodes_) {
      for (V& f : node.force) f = T::broadcast(0);
    }
  }
  template <model::JointKind kind>
  void up(int node, int parent, bool is_first, Scalar bias, const BodyLanes<T>& bodies,
          JointRows<T, kind>& rows);
  void root(int node, Twist<V>& twist);
  template <model::JointKind kind>
  void down(int node, int parent, bool is_first, BodyLanes<T>& bodies, JointRows<T, kind>& rows);

 private:
  struct alignas(sizeof(V)) Node {
    SymmetricFactor<T, 6> mass;
    V sum[6][6];                ///< mass plus what the children have added: lower triangle
    V force[6];                 ///< force from the children; then the change of the twist
    JointJacobian<T> jacobian;  ///< of the joint to the parent
    SymmetricFactor<T, 6> schur;
    V error[6];
  };
  static const V (*child_of(const Node& node, bool is_first))[6] {
    return is_first ? node.jacobian.a : node.jacobian.b;
  }
  static const V (*parent_of(const Node& node, bool is_first))[6] {
    return is_first ? node.jacobian.b : node.jacobian.a;
  }
  static void add(const V* u, Twist<V>& twist) {
    twist.linear = twist.linear + Vec3L<V>{u[0], u[1], u[2]};
    twist.angular = twist.angular + Vec3L<V>{u[3], u[4], u[5]};
  }

  std::vector<Node> nodes_;
};

template <class T>
void TreeSolver<T>::start_body(int node, const BodyLane<V>& body) {
  Node& own = nodes_[static_cast<std::size_t>(node)];
  for (auto& row : own.sum) {
    for (V& number : row) number = T::broadcast(0);
  }
  const V mass = 1 / body.inv_mass;
  own.sum[0][0] = own.sum[1][1] = own.sum[2][2] = mass;
  // The inertia at the step's start, which contacts, limits and carried impulses also use, and not that of
  // the current pose: solving with two inertias in turn gains energy.
  const Sym3L<V> inertia = inverse(body.inv_inertia);
  own.sum[3][3] = inertia.xx;
  own.sum[4][3] = inertia.xy;
  own.sum[4][4] = inertia.yy;
  own.sum[5][3] = inertia.xz;
  own.sum[5][4] = inertia.yz;
  own.sum[5][5] = inertia.zz;
}

template <class T>
template <model::JointKind kind>
void TreeSolver<T>::eliminate(int node, int parent, bool is_first, Scalar cfm,
                              const JointRows<T, kind>& rows) {
  constexpr int n = num_held_rows(kind);
  Node& own = nodes_[static_cast<std::size_t>(node)];
  own.mass.factor(own.sum);
  set_jacobian(rows, cfm, own.jacobian);
  const auto* child = child_of(own, is_first);
  V s[6][6];
  for (int row = 0; row < n; ++row) {
    V w[6];
    for (int i = 0; i < 6; ++i) w[i] = child[row][i];
    own.mass.solve(w);
    for (int other = row; other < n; ++other) {
      V sum = child[other][0] * w[0];
      for (int i = 1; i < 6; ++i) sum += child[other][i] * w[i];
      s[other][row] = sum;
    }
    s[row][row] += own.jacobian.cfm[row] + (1 - own.jacobian.holds[row]);
  }
  own.schur.template factor<n>(s);
  if (parent < 0) return;
  Node& above = nodes_[static_cast<std::size_t>(parent)];
  const auto* held = parent_of(own, is_first);
  for (int column = 0; column < 6; ++column) {
    V b[6];
    for (int row = 0; row < n; ++row) b[row] = held[row][column];
    own.schur.template solve<n>(b);
    for (int i = column; i < 6; ++i) {
      V sum = above.sum[i][column];
      for (int row = 0; row < n; ++row) sum += held[row][i] * b[row];
      above.sum[i][column] = sum;
    }
  }
}

template <class T>
template <model::JointKind kind>
void TreeSolver<T>::up(int node, int parent, bool is_first, Scalar bias, const BodyLanes<T>& bodies,
                       JointRows<T, kind>& rows) {
  constexpr int n = num_held_rows(kind);
  Node& own = nodes_[static_cast<std::size_t>(node)];
  const Twist<V>&a = bodies.twists[rows.slot_a], &b = bodies.twists[rows.slot_b];
  const V va[6] = {a.linear.x, a.linear.y, a.linear.z, a.angular.x, a.angular.y, a.angular.z};
  const V vb[6] = {b.linear.x, b.linear.y, b.linear.z, b.angular.x, b.angular.y, b.angular.z};
  V y[6];
  for (int i = 0; i < 6; ++i) y[i] = own.force[i];
  own.mass.solve(y);
  const auto* child = child_of(own, is_first);
  for_each_held_row(rows, bias, [&](int row, const V& rhs, const V& impulse) {
    V error = (rhs - own.jacobian.cfm[row] * impulse) * own.jacobian.holds[row];
    for (int i = 0; i < 6; ++i)
      error -= own.jacobian.a[row][i] * va[i] + own.jacobian.b[row][i] * vb[i] + child[row][i] * y[i];
    own.error[row] = error;
  });
  if (parent < 0) return;
  V z[6];
  for (int row = 0; row < n; ++row) z[row] = own.error[row];
  own.schur.template solve<n>(z);
  Node& above = nodes_[static_cast<std::size_t>(parent)];
  const auto* held = parent_of(own, is_first);
  for (int i = 0; i < 6; ++i) {
    V sum = above.force[i];
    for (int row = 0; row < n; ++row) sum += held[row][i] * z[row];
    above.force[i] = sum;
  }
}

template <class T>
void TreeSolver<T>::root(int node, Twist<V>& twist) {
  Node& own = nodes_[static_cast<std::size_t>(node)];
  own.mass.solve(own.force);
  add(own.force, twist);
}

template <class T>
template <model::JointKind kind>
void TreeSolver<T>::down(int node, int parent, bool is_first, BodyLanes<T>& bodies,
                         JointRows<T, kind>& rows) {
  constexpr int n = num_held_rows(kind);
  Node& own = nodes_[static_cast<std::size_t>(node)];
  V change[6];
  for (int row = 0; row < n; ++row) change[row] = own.error[row];
  if (parent >= 0) {
    const Node& above = nodes_[static_cast<std::size_t>(parent)];
    const auto* held = parent_of(own, is_first);
    for (int row = 0; row < n; ++row) {
      for (int i = 0; i < 6; ++i) change[row] -= held[row][i] * above.force[i];
    }
  }
  own.schur.template solve<n>(change);
  const auto* child = child_of(own, is_first);
  for (int i = 0; i < 6; ++i) {
    for (int row = 0; row < n; ++row) own.force[i] += child[row][i] * change[row];
  }
  own.mass.solve(own.force);
  add(own.force, bodies.twists[is_first ? rows.slot_a : rows.slot_b]);
  for_each_held_row(rows, Scalar{1}, [&](int row, const V&, V& impulse) { impulse += change[row]; });
}

}  // namespace pbmpi::solver
