/// Numbers side by side: one vector register holds the same quantity of several worlds (or of several
/// contacts).
///
/// GCC and clang vector extensions: the four operators work on scalars and vectors alike, so that one source
/// serves one lane and sixteen. What is done in a lane depends on nothing in the other lanes, and contraction
/// is off: a lane's bits are those of the scalar code.
#pragma once

#include <cmath>
#include <cstdint>
#include <type_traits>

namespace pbmpi::solver {

template <class Scalar, int num_lanes>
struct LanesOf {
  typedef Scalar Vector __attribute__((vector_size(num_lanes * sizeof(Scalar))));
};
template <class Scalar>
struct LanesOf<Scalar, 1> {
  using Vector = Scalar;
};

/// `num_lanes` numbers; a plain Scalar for one lane.
template <class Scalar, int num_lanes>
using Lanes = typename LanesOf<Scalar, num_lanes>::Vector;

/// What the code below needs to know of a lane type.
template <class Scalar_, int num_lanes_>
struct LaneTraits {
  using Scalar = Scalar_;
  using V = Lanes<Scalar, num_lanes_>;
  static constexpr int num_lanes = num_lanes_;

  static V broadcast(Scalar value) {
    if constexpr (num_lanes == 1) {
      return value;
    } else {
      return V{} + value;
    }
  }
  static Scalar get(const V& v, int lane) {
    if constexpr (num_lanes == 1) {
      return v;
    } else {
      return v[lane];
    }
  }
  static void set(V& v, int lane, Scalar value) {
    if constexpr (num_lanes == 1) {
      v = value;
    } else {
      v[lane] = value;
    }
  }
  /// The larger of two, lane by lane (b where either is NaN).
  static V max(const V& a, const V& b) { return a > b ? a : b; }
  static V min(const V& a, const V& b) { return a < b ? a : b; }
  static V abs(const V& a) { return a < V{} ? -a : a; }
  static V sqrt(const V& a) {
    if constexpr (num_lanes == 1) {
      return std::sqrt(a);
    } else {
      V result;
      for (int lane = 0; lane < num_lanes; ++lane) result[lane] = std::sqrt(a[lane]);
      return result;
    }
  }
  /// base[index[lane]] for each lane.
  static V gather(const Scalar* base, const std::int32_t* index) {
    if constexpr (num_lanes == 1) {
      return base[index[0]];
    } else {
      V result;
      for (int lane = 0; lane < num_lanes; ++lane) result[lane] = base[index[lane]];
      return result;
    }
  }
  static void scatter(Scalar* base, const std::int32_t* index, const V& v) {
    if constexpr (num_lanes == 1) {
      base[index[0]] = v;
    } else {
      for (int lane = 0; lane < num_lanes; ++lane) base[index[lane]] = v[lane];
    }
  }
};

/// Three components, each a lane vector.
///
/// Every struct of lane vectors states its alignment: g++ gives a vector the alignment that the instruction
/// set of the place can use, and the standard library's allocator is compiled for the plainest set.
template <class V>
struct alignas(sizeof(V)) Vec3L {
  V x, y, z;

  Vec3L operator+(const Vec3L& o) const { return {x + o.x, y + o.y, z + o.z}; }
  Vec3L operator-(const Vec3L& o) const { return {x - o.x, y - o.y, z - o.z}; }
  Vec3L operator-() const { return {-x, -y, -z}; }
  Vec3L operator*(const V& s) const { return {x * s, y * s, z * s}; }
};

template <class V>
V dot(const Vec3L<V>& a, const Vec3L<V>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

template <class V>
Vec3L<V> cross(const Vec3L<V>& a, const Vec3L<V>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// Symmetric 3x3.
template <class V>
struct alignas(sizeof(V)) Sym3L {
  V xx, xy, xz, yy, yz, zz;

  Vec3L<V> operator*(const Vec3L<V>& v) const {
    return {xx * v.x + xy * v.y + xz * v.z, xy * v.x + yy * v.y + yz * v.z, xz * v.x + yz * v.y + zz * v.z};
  }
};

/// Rotation matrix by rows.
template <class V>
struct alignas(sizeof(V)) Mat3L {
  Vec3L<V> row0, row1, row2;

  Vec3L<V> operator*(const Vec3L<V>& v) const { return {dot(row0, v), dot(row1, v), dot(row2, v)}; }
};

}  // namespace pbmpi::solver
