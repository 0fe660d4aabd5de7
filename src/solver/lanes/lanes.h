/// Numbers side by side: one vector register holds the same quantity of several worlds (or of several
/// contacts).
///
/// GCC and clang vector extensions: the four operators work on scalars and vectors alike, so that one source
/// serves one lane and sixteen. A lane's results do not depend on the other lanes, and contraction is off: a
/// lane's bits are those of the scalar code.
#pragma once

#if defined(__x86_64__)
#include <immintrin.h>
#endif

#include <cmath>
#include <cstdint>
#include <cstring>
#include <type_traits>

/// Functions on lane vectors must be inlined: a call would pass vector registers through memory, and spill
/// the caller's own.
#define PBMPI_LANES [[gnu::always_inline]] inline

namespace pbmpi::solver {

template <class Scalar, int num_lanes>
struct LanesOf {
  typedef Scalar Vector __attribute__((vector_size(num_lanes * sizeof(Scalar))));
};
template <class Scalar>
struct LanesOf<Scalar, 1> {
  using Vector = Scalar;
};

/// Stands for infinity: far above any impulse [N s] or length [m], and finite in float.
inline constexpr double huge_bound = 1e30;

/// `num_lanes` numbers; a plain Scalar for one lane.
template <class Scalar, int num_lanes>
using Lanes = typename LanesOf<Scalar, num_lanes>::Vector;

/// A lane type and its basic operations.
template <class Scalar_, int num_lanes_>
struct LaneTraits {
  using Scalar = Scalar_;
  using V = Lanes<Scalar, num_lanes_>;
  static constexpr int num_lanes = num_lanes_;

  PBMPI_LANES static V broadcast(Scalar value) {
    if constexpr (num_lanes == 1) {
      return value;
    } else {
      return V{} + value;
    }
  }
  PBMPI_LANES static Scalar get(const V& v, int lane) {
    if constexpr (num_lanes == 1) {
      return v;
    } else {
      return v[lane];
    }
  }
  PBMPI_LANES static void set(V& v, int lane, Scalar value) {
    if constexpr (num_lanes == 1) {
      v = value;
    } else {
      v[lane] = value;
    }
  }
  /// The larger of the two, lane by lane (b where either is NaN).
  PBMPI_LANES static V max(const V& a, const V& b) { return a > b ? a : b; }
  PBMPI_LANES static V min(const V& a, const V& b) { return a < b ? a : b; }
  PBMPI_LANES static V abs(const V& a) { return a < V{} ? -a : a; }
  PBMPI_LANES static V sqrt(const V& a) {
    if constexpr (num_lanes == 1) {
      return std::sqrt(a);
    } else {
#if defined(__x86_64__)
      return sqrt_x86(a);
#else
      V result;
      for (int lane = 0; lane < num_lanes; ++lane) result[lane] = std::sqrt(a[lane]);
      return result;
#endif
    }
  }
  /// Is any lane other than 0?
  PBMPI_LANES static bool any(const V& v) { return bits(v) != 0; }
  /// num_lanes consecutive numbers, aligned or not.
  PBMPI_LANES static V load(const Scalar* from) {
    V v;
    std::memcpy(&v, from, sizeof v);
    return v;
  }
  /// Bit `lane` is set where `flags` is not 0.
  PBMPI_LANES static unsigned bits(const V& flags) {
    if constexpr (num_lanes == 1) {
      return flags != 0 ? 1u : 0u;
    } else {
#if defined(__x86_64__)
      return bits_x86(flags);
#else
      unsigned result = 0;
      for (int lane = 0; lane < num_lanes; ++lane) result |= flags[lane] != 0 ? 1u << lane : 0u;
      return result;
#endif
    }
  }
  /// The same number of lanes in double precision, for what single precision does not bear; and there and
  /// back.
  using Wide = LaneTraits<double, num_lanes_>;
  PBMPI_LANES static typename Wide::V widen(const V& v) {
    if constexpr (num_lanes == 1) {
      return v;
    } else {
      return __builtin_convertvector(v, typename Wide::V);
    }
  }
  PBMPI_LANES static V narrow(const typename Wide::V& v) {
    if constexpr (num_lanes == 1) {
      return static_cast<Scalar>(v);
    } else {
      return __builtin_convertvector(v, V);
    }
  }
  /// base[index[lane]] for each lane.
  PBMPI_LANES static V gather(const Scalar* base, const std::int32_t* index) {
    if constexpr (num_lanes == 1) {
      return base[index[0]];
#if defined(__x86_64__)
    } else if constexpr (is_512 && is_single) {
      return V(_mm512_i32gather_ps(_mm512_loadu_si512(index), base, sizeof(Scalar)));
    } else if constexpr (is_512) {
      return V(_mm512_i32gather_pd(_mm256_loadu_si256(reinterpret_cast<const __m256i*>(index)), base,
                                   sizeof(Scalar)));
#endif
    } else {
      V result;
      for (int lane = 0; lane < num_lanes; ++lane) result[lane] = base[index[lane]];
      return result;
    }
  }

 private:
  static constexpr bool is_single = std::is_same_v<Scalar, float>;
  static constexpr bool is_512 = sizeof(Scalar) * num_lanes == 64;
  static constexpr bool is_256 = sizeof(Scalar) * num_lanes == 32;

#if defined(__x86_64__)
  PBMPI_LANES static unsigned bits_x86(const V& flags) {
    if constexpr (is_512 && is_single) {
      return _mm512_cmp_ps_mask(__m512(flags), _mm512_setzero_ps(), _CMP_NEQ_UQ);
    } else if constexpr (is_512) {
      return _mm512_cmp_pd_mask(__m512d(flags), _mm512_setzero_pd(), _CMP_NEQ_UQ);
    } else if constexpr (is_256 && is_single) {
      return static_cast<unsigned>(_mm256_movemask_ps(__m256(flags != 0)));
    } else if constexpr (is_256) {
      return static_cast<unsigned>(_mm256_movemask_pd(__m256d(flags != 0)));
    } else if constexpr (is_single) {
      return static_cast<unsigned>(_mm_movemask_ps(__m128(flags != 0)));
    } else {
      return static_cast<unsigned>(_mm_movemask_pd(__m128d(flags != 0)));
    }
  }
  PBMPI_LANES static V sqrt_x86(const V& a) {
    if constexpr (is_512 && is_single) {
      return V(_mm512_sqrt_ps(__m512(a)));
    } else if constexpr (is_512) {
      return V(_mm512_sqrt_pd(__m512d(a)));
    } else if constexpr (is_256 && is_single) {
      return V(_mm256_sqrt_ps(__m256(a)));
    } else if constexpr (is_256) {
      return V(_mm256_sqrt_pd(__m256d(a)));
    } else if constexpr (is_single) {
      return V(_mm_sqrt_ps(__m128(a)));
    } else {
      return V(_mm_sqrt_pd(__m128d(a)));
    }
  }
#endif
};

/// Three components, each a lane vector.
///
/// Every struct of lane vectors states its alignment: g++ gives a vector the alignment that the instruction
/// set in force can use, and the standard library's allocator is compiled for the baseline set.
template <class V>
struct alignas(sizeof(V)) Vec3L {
  V x, y, z;

  PBMPI_LANES Vec3L operator+(const Vec3L& o) const { return {x + o.x, y + o.y, z + o.z}; }
  PBMPI_LANES Vec3L operator-(const Vec3L& o) const { return {x - o.x, y - o.y, z - o.z}; }
  PBMPI_LANES Vec3L operator-() const { return {-x, -y, -z}; }
  PBMPI_LANES Vec3L operator*(const V& s) const { return {x * s, y * s, z * s}; }
};

template <class V>
PBMPI_LANES V dot(const Vec3L<V>& a, const Vec3L<V>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

template <class V>
PBMPI_LANES Vec3L<V> cross(const Vec3L<V>& a, const Vec3L<V>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// a in the lanes where a comparison holds, else b.
template <class Mask, class V>
PBMPI_LANES Vec3L<V> chosen(const Mask& first, const Vec3L<V>& a, const Vec3L<V>& b) {
  return {first ? a.x : b.x, first ? a.y : b.y, first ? a.z : b.z};
}

/// Symmetric 3x3.
template <class V>
struct alignas(sizeof(V)) Sym3L {
  V xx, xy, xz, yy, yz, zz;

  PBMPI_LANES Vec3L<V> operator*(const Vec3L<V>& v) const {
    return {xx * v.x + xy * v.y + xz * v.z, xy * v.x + yy * v.y + yz * v.z, xz * v.x + yz * v.y + zz * v.z};
  }
};

/// The inverse, by cofactors.
template <class V>
PBMPI_LANES Sym3L<V> inverse(const Sym3L<V>& m) {
  const V xx = m.yy * m.zz - m.yz * m.yz, xy = m.xz * m.yz - m.xy * m.zz, xz = m.xy * m.yz - m.xz * m.yy;
  const V scale = 1 / (m.xx * xx + m.xy * xy + m.xz * xz);
  return {xx * scale,
          xy * scale,
          xz * scale,
          (m.xx * m.zz - m.xz * m.xz) * scale,
          (m.xy * m.xz - m.xx * m.yz) * scale,
          (m.xx * m.yy - m.xy * m.xy) * scale};
}

/// Rotation matrix by rows.
template <class V>
struct alignas(sizeof(V)) Mat3L {
  Vec3L<V> row0, row1, row2;

  PBMPI_LANES Vec3L<V> operator*(const Vec3L<V>& v) const {
    return {dot(row0, v), dot(row1, v), dot(row2, v)};
  }
  PBMPI_LANES Vec3L<V> transposed_times(const Vec3L<V>& v) const {
    return row0 * v.x + row1 * v.y + row2 * v.z;
  }
};

}  // namespace pbmpi::solver
