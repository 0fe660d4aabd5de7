/// Builds single rows of joints from the poses of their two bodies.
#pragma once

#include "solver/joints/joint_rows.h"
#include "solver/joints/joint_terms.h"

namespace pbmpi::solver {

/// The two bodies of a joint.
template <class V>
struct JointBodies {
  const BodyLane<V>&a, &b;
};

/// (q_a^-1 q_b) relative^-1: how b has turned relative to a since the start.
template <class V>
struct alignas(sizeof(V)) RelativeRotation {
  V w;
  Vec3L<V> vector;  ///< a's frame
};

template <class V>
PBMPI_LANES RelativeRotation<V> relative_rotation(const JointTermsLane<V>& terms,
                                                  const JointBodies<V>& pair) {
  const auto& [a, b] = pair;
  const V rw = a.qw * b.qw + a.qx * b.qx + a.qy * b.qy + a.qz * b.qz;
  const V rx = a.qw * b.qx - a.qx * b.qw - a.qy * b.qz + a.qz * b.qy;
  const V ry = a.qw * b.qy - a.qy * b.qw - a.qz * b.qx + a.qx * b.qz;
  const V rz = a.qw * b.qz - a.qz * b.qw - a.qx * b.qy + a.qy * b.qx;
  const V &sw = terms.relative_w, &sx = terms.relative_x, &sy = terms.relative_y, &sz = terms.relative_z;
  return {rw * sw + rx * sx + ry * sy + rz * sz,
          {rx * sw - rw * sx - ry * sz + rz * sy, ry * sw - rw * sy - rz * sx + rx * sz,
           rz * sw - rw * sz - rx * sy + ry * sx}};
}

/// Holds what is uniform in a substep's rows, and sets single rows.
template <class T>
class RowBuilder {
 public:
  using V = typename T::V;
  using Scalar = typename T::Scalar;
  using L3 = Vec3L<V>;
  using Pair = JointBodies<V>;

  /// `place_k`, `turn_k` [1/s]: the rates at which errors are to be removed; `cfm`: divided by the step.
  RowBuilder(Scalar place_k, Scalar turn_k, Scalar cfm) : place_k_(place_k), turn_k_(turn_k), cfm_(cfm) {}

  Scalar place_k() const { return place_k_; }
  Scalar turn_k() const { return turn_k_; }
  Scalar cfm() const { return cfm_; }

  /// Leave the impulse as it is.
  PBMPI_LANES void set_axis(const L3& axis, const V& rhs, const Pair& pair, AxisRow<V>& row) const;
  PBMPI_LANES void set_line(const L3& direction, const L3& moment_a, const L3& moment_b, const V& rhs,
                            const V& cfm, const Pair& pair, LineRow<V>& row) const;

 private:
  Scalar place_k_, turn_k_, cfm_;
};

/// From the centre of a to where a slider's lines act: the midpoint of its two bodies, whose centres are
/// `apart`; the centre itself if a slides on the world, whose origin has nothing to do with the joint (as in
/// ODE).
template <class T>
PBMPI_LANES Vec3L<typename T::V> slider_arm(const JointBodies<typename T::V>& pair,
                                            const Vec3L<typename T::V>& apart) {
  const auto zero = T::broadcast(0), half = T::broadcast(static_cast<typename T::Scalar>(0.5));
  return apart * (pair.b.inv_mass > zero ? half : zero);
}

template <class T>
PBMPI_LANES void RowBuilder<T>::set_axis(const L3& axis, const V& rhs, const Pair& pair,
                                         AxisRow<V>& row) const {
  row.axis = axis;
  row.turn_a = pair.a.inv_inertia * axis;
  row.turn_b = pair.b.inv_inertia * axis;
  row.rhs = rhs;
  row.ahead = T::broadcast(0);
}

template <class T>
PBMPI_LANES void RowBuilder<T>::set_line(const L3& direction, const L3& moment_a, const L3& moment_b,
                                         const V& rhs, const V& cfm, const Pair& pair,
                                         LineRow<V>& row) const {
  row.direction = direction;
  row.moment_a = moment_a;
  row.moment_b = moment_b;
  row.turn_a = pair.a.inv_inertia * moment_a;
  row.turn_b = pair.b.inv_inertia * moment_b;
  row.rhs = rhs;
  row.ahead = T::broadcast(0);
  row.cfm = cfm;
}

}  // namespace pbmpi::solver
