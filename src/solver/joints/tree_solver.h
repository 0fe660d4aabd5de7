/// Solves the joints of a tree of bodies exactly: elimination from the leaves to the root and back, which
/// takes time linear in the number of joints (D. Baraff, "Linear-Time Dynamics using Lagrange Multipliers",
/// SIGGRAPH 1996; the recursion is that of R. Featherstone's articulated-body inertia).
#pragma once

#include <array>
#include <vector>

#include "solver/joints/articulation_tree.h"
#include "solver/joints/joint_jacobian.h"
#include "solver/joints/joint_solver.h"
#include "solver/lanes/symmetric_factor.h"

namespace pbmpi::solver {

/// Solves one batch. The bodies' changes of twist u and the rows' impulses p satisfy
///   M u = J^T p,  J u + C p = r,  r = rhs - J v - C p_before.
/// A rotor of inertia I is a row with rhs = its speed at the start and C = 1 / I.
/// With its subtree eliminated a body c below a joint to its parent has the mass M_c' and the force f_c; the
/// joint has S = J_c M_c'^-1 J_c^T + C, and adds J_p^T S^-1 J_p to the parent's mass.
/// Computes in double precision: a light body between heavy ones leaves little of what is subtracted.
template <class T>
class alignas(sizeof(typename T::Wide::V)) TreeSolver {
 public:
  using V = typename T::V;
  using Scalar = typename T::Scalar;

  explicit TreeSolver(int num_bodies) : nodes_(static_cast<std::size_t>(num_bodies)) {}

  /// Body by body, children before parents.
  void start_body(int node, const BodyLane<V>& body);
  /// For all of these: `n`: the joint's held rows, or all rows if it has rotors.
  template <int n, model::JointKind kind>
  void eliminate(int node, int parent, bool is_first, Scalar cfm, const JointRows<T, kind>& rows);
  void close_root(int node) {
    Node& own = nodes_[static_cast<std::size_t>(node)];
    own.mass.factor(own.sum);
  }

  // What the bodies answer to a wrench, after these: answer_root() and answer(), parents before children.
  void answer_root(int node);
  template <int n>
  void answer(int node, int parent, bool is_first);
  /// [6][6] Twist of a body under a wrench of 1, with all joints and rotors; linear components first.
  const typename T::Wide::V (&answer_of(int node) const)[6][6] {
    return nodes_[static_cast<std::size_t>(node)].answer;
  }

  // A solve: start_solve(); up() children before parents; root(); down() parents before children.
  /// `exact`: 1 in the lanes that take the solution, else 0.
  void start_solve(const V& exact) {
    exact_ = exact;
    for (Node& node : nodes_) {
      for (W& f : node.force) f = Wide::broadcast(0);
    }
  }
  template <int n, model::JointKind kind>
  void up(int node, int parent, bool is_first, const JointSolver<T>& solver, const BodyLanes<T>& bodies,
          JointRows<T, kind>& rows);
  void root(int node, Twist<V>& twist);
  template <int n, model::JointKind kind>
  void down(int node, int parent, bool is_first, const JointSolver<T>& solver, BodyLanes<T>& bodies,
            JointRows<T, kind>& rows);

 private:
  using Wide = typename T::Wide;
  using W = typename Wide::V;
  struct alignas(sizeof(W)) Node {
    SymmetricFactor<Wide, 6> mass;
    W sum[6][6];                ///< mass plus what the children have added: lower triangle
    W force[6];                 ///< force from the children; then the change of the twist
    JointJacobian<T> jacobian;  ///< of the joint to the parent
    SymmetricFactor<Wide, 6> schur;
    W error[6];
    W answer[6][6];
  };
  static const W (*child_of(const Node& node, bool is_first))[6] {
    return is_first ? node.jacobian.a : node.jacobian.b;
  }
  static const W (*parent_of(const Node& node, bool is_first))[6] {
    return is_first ? node.jacobian.b : node.jacobian.a;
  }
  /// Lanes that do not take the solution keep their bits.
  void add(const W* u, Twist<V>& twist) const {
    const auto is_exact = exact_ > T::broadcast(0);
    for (V* part : {&twist.linear.x, &twist.linear.y, &twist.linear.z, &twist.angular.x, &twist.angular.y,
                    &twist.angular.z})
      *part = is_exact ? *part + T::narrow(*u++) : *part;
  }

  std::vector<Node> nodes_;
  V exact_ = T::broadcast(1);
};

template <class T>
void TreeSolver<T>::start_body(int node, const BodyLane<V>& body) {
  Node& own = nodes_[static_cast<std::size_t>(node)];
  for (auto& row : own.sum) {
    for (W& number : row) number = Wide::broadcast(0);
  }
  const W mass = 1 / T::widen(body.inv_mass);
  own.sum[0][0] = own.sum[1][1] = own.sum[2][2] = mass;
  const Sym3L<V>& inv = body.inv_inertia;
  const Sym3L<W> inertia = inverse(Sym3L<W>{T::widen(inv.xx), T::widen(inv.xy), T::widen(inv.xz),
                                            T::widen(inv.yy), T::widen(inv.yz), T::widen(inv.zz)});
  own.sum[3][3] = inertia.xx;
  own.sum[4][3] = inertia.xy;
  own.sum[4][4] = inertia.yy;
  own.sum[5][3] = inertia.xz;
  own.sum[5][4] = inertia.yz;
  own.sum[5][5] = inertia.zz;
}

template <class T>
template <int n, model::JointKind kind>
void TreeSolver<T>::eliminate(int node, int parent, bool is_first, Scalar cfm,
                              const JointRows<T, kind>& rows) {
  Node& own = nodes_[static_cast<std::size_t>(node)];
  own.mass.factor(own.sum);
  set_jacobian(rows, cfm, own.jacobian);
  const auto* child = child_of(own, is_first);
  W s[6][6];
  for (int row = 0; row < n; ++row) {
    W w[6];
    for (int i = 0; i < 6; ++i) w[i] = child[row][i];
    own.mass.solve(w);
    for (int other = row; other < n; ++other) {
      W sum = child[other][0] * w[0];
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
    W b[6];
    for (int row = 0; row < n; ++row) b[row] = held[row][column];
    own.schur.template solve<n>(b);
    for (int i = column; i < 6; ++i) {
      W sum = above.sum[i][column];
      for (int row = 0; row < n; ++row) sum += held[row][i] * b[row];
      above.sum[i][column] = sum;
    }
  }
}

template <class T>
void TreeSolver<T>::answer_root(int node) {
  Node& own = nodes_[static_cast<std::size_t>(node)];
  for (int column = 0; column < 6; ++column) {
    W x[6];
    for (int i = 0; i < 6; ++i) x[i] = Wide::broadcast(i == column ? 1 : 0);
    own.mass.solve(x);
    for (int i = 0; i < 6; ++i) own.answer[i][column] = x[i];
  }
}

/// With f a wrench on the child, x = M_c'^-1 f and q = S^-1 J_c x, the parent moves by u_p = -A_p J_p^T q,
/// the joint's impulses are p = -q - S^-1 J_p u_p, and the child moves by M_c'^-1 (f + J_c^T p).
template <class T>
template <int n>
void TreeSolver<T>::answer(int node, int parent, bool is_first) {
  Node& own = nodes_[static_cast<std::size_t>(node)];
  const auto *child = child_of(own, is_first), *held = parent_of(own, is_first);
  for (int column = 0; column < 6; ++column) {
    W x[6], p[6];
    for (int i = 0; i < 6; ++i) x[i] = Wide::broadcast(i == column ? 1 : 0);
    own.mass.solve(x);
    for (int row = 0; row < n; ++row) {
      p[row] = -(child[row][0] * x[0]);
      for (int i = 1; i < 6; ++i) p[row] -= child[row][i] * x[i];
    }
    own.schur.template solve<n>(p);
    if (parent >= 0) {
      const auto& above = nodes_[static_cast<std::size_t>(parent)].answer;
      W wrench[6], moved[6], q[6];
      for (int i = 0; i < 6; ++i) {
        wrench[i] = held[0][i] * p[0];
        for (int row = 1; row < n; ++row) wrench[i] += held[row][i] * p[row];
      }
      for (int i = 0; i < 6; ++i) {
        moved[i] = above[i][0] * wrench[0];
        for (int k = 1; k < 6; ++k) moved[i] += above[i][k] * wrench[k];
      }
      for (int row = 0; row < n; ++row) {
        q[row] = held[row][0] * moved[0];
        for (int i = 1; i < 6; ++i) q[row] += held[row][i] * moved[i];
      }
      own.schur.template solve<n>(q);
      for (int row = 0; row < n; ++row) p[row] -= q[row];
    }
    W u[6];
    for (int i = 0; i < 6; ++i) {
      u[i] = Wide::broadcast(i == column ? 1 : 0);
      for (int row = 0; row < n; ++row) u[i] += child[row][i] * p[row];
    }
    own.mass.solve(u);
    for (int i = 0; i < 6; ++i) own.answer[i][column] = u[i];
  }
}

template <class T>
template <int n, model::JointKind kind>
void TreeSolver<T>::up(int node, int parent, bool is_first, const JointSolver<T>& solver,
                       const BodyLanes<T>& bodies, JointRows<T, kind>& rows) {
  Node& own = nodes_[static_cast<std::size_t>(node)];
  const Twist<V>&a = bodies.twists[rows.slot_a], &b = bodies.twists[rows.slot_b];
  const auto wide = [](const Twist<V>& twist, W* to) {
    const auto& [v, w] = twist;
    for (const V* part : {&v.x, &v.y, &v.z, &w.x, &w.y, &w.z}) *to++ = T::widen(*part);
  };
  W va[6], vb[6];
  wide(a, va);
  wide(b, vb);
  W y[6];
  for (int i = 0; i < 6; ++i) y[i] = own.force[i];
  own.mass.solve(y);
  const auto* child = child_of(own, is_first);
  const auto set_error = [&](int row, const V& right, const V& impulse) {
    W error = (T::widen(right) - own.jacobian.cfm[row] * T::widen(impulse)) * own.jacobian.holds[row];
    for (int i = 0; i < 6; ++i)
      error -= own.jacobian.a[row][i] * va[i] + own.jacobian.b[row][i] * vb[i] + child[row][i] * y[i];
    own.error[row] = error;
  };
  const V bias = T::broadcast(solver.laws().exact_bias);
  int next = 0;
  for_each_held_row(
      rows, solver.laws(), solver.cfm(),
      [&](int, const V& rhs, const V& ahead, const V&, const V& impulse, const RowLaw<Scalar>& law) {
        const bool springs = rows.sprung && next == 0;
        set_error(next++, springs ? rhs : rhs * bias + ahead * T::broadcast(law.bias), impulse);
      });
  if (rows.has_rotors) {
    for_each_control(rows, [&](const auto& control, std::size_t) {
      set_error(next++, control.rotor.start, control.rotor.impulse);
    });
  }
  if (parent < 0) return;
  W z[6];
  for (int row = 0; row < n; ++row) z[row] = own.error[row];
  own.schur.template solve<n>(z);
  Node& above = nodes_[static_cast<std::size_t>(parent)];
  const auto* held = parent_of(own, is_first);
  for (int i = 0; i < 6; ++i) {
    W sum = above.force[i];
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
template <int n, model::JointKind kind>
void TreeSolver<T>::down(int node, int parent, bool is_first, const JointSolver<T>& solver,
                         BodyLanes<T>& bodies, JointRows<T, kind>& rows) {
  Node& own = nodes_[static_cast<std::size_t>(node)];
  W change[6];
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
  for_each_held_row(rows, solver.laws(), solver.cfm(),
                    [&](int row, const V&, const V&, const V&, V& impulse, const RowLaw<Scalar>&) {
                      impulse = exact_ > T::broadcast(0) ? impulse + T::narrow(change[row]) : impulse;
                    });
  if (rows.has_rotors) {
    for_each_control(rows, [&](auto& control, std::size_t i) {
      V& impulse = control.rotor.impulse;
      const V added = T::narrow(change[JointRows<T, kind>::counts.held() + static_cast<int>(i)]);
      impulse = exact_ > T::broadcast(0) ? impulse + added : impulse;
    });
  }
}

}  // namespace pbmpi::solver
