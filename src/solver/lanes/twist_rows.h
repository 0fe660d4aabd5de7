/// Velocities body by body, for the contacts. A contact's lanes take theirs from bodies anywhere in the pack:
/// with a row for each body that is one load and one store a lane, and the rows are transposed in registers.
/// Gathering them component by component took six times as many memory operations, and half of a sweep's
/// time.
#pragma once

#include <cstdint>
#include <vector>

#include "solver/lanes/rows.h"

namespace pbmpi::solver {

/// Numbers in a row: three of the linear and three of the angular velocity, each followed by an unused one.
inline constexpr int twist_row_size = 8;
inline constexpr int first_angular = 4;

/// Moves num_lanes rows of twists to and from lanes; `at[lane]`: where a row begins, in numbers.
template <class T>
struct TwistTranspose {
  using V = typename T::V;
  using Scalar = typename T::Scalar;

  PBMPI_LANES static Twist<V> load(const Scalar* rows, const std::int32_t* at) {
    if constexpr (sizeof(V) == 64 && sizeof(Scalar) == 4) {
      return load_512_single(rows, at);
    } else if constexpr (sizeof(V) == 64) {
      return load_512_double(rows, at);
    } else {
      return {load_half(rows, at), load_half(rows + first_angular, at)};
    }
  }

  PBMPI_LANES static void store(Scalar* rows, const std::int32_t* at, const Twist<V>& twist) {
    if constexpr (sizeof(V) == 64 && sizeof(Scalar) == 4) {
      store_512_single(rows, at, twist);
    } else if constexpr (sizeof(V) == 64) {
      store_512_double(rows, at, twist);
    } else {
      store_half(rows, at, twist.linear);
      store_half(rows + first_angular, at, twist.angular);
    }
  }

  /// Loads the first half of each row: the linear velocities.
  PBMPI_LANES static Vec3L<V> load_half(const Scalar* rows, const std::int32_t* at) {
    if constexpr (sizeof(V) == 64 && sizeof(Scalar) == 4) {
      return load_half_512_single(rows, at);
    } else if constexpr (sizeof(V) == 64) {
      return load_half_512_double(rows, at);
    } else {
      alignas(V) Scalar columns[3][T::num_lanes];
      for (int lane = 0; lane < T::num_lanes; ++lane) {
        for (int k = 0; k < 3; ++k) columns[k][lane] = rows[at[lane] + k];
      }
      return {T::load(columns[0]), T::load(columns[1]), T::load(columns[2])};
    }
  }

  PBMPI_LANES static void store_half(Scalar* rows, const std::int32_t* at, const Vec3L<V>& linear) {
    if constexpr (sizeof(V) == 64 && sizeof(Scalar) == 4) {
      store_half_512_single(rows, at, linear);
    } else if constexpr (sizeof(V) == 64) {
      store_half_512_double(rows, at, linear);
    } else {
      for (int lane = 0; lane < T::num_lanes; ++lane) {
        Scalar* row = rows + at[lane];
        row[0] = T::get(linear.x, lane);
        row[1] = T::get(linear.y, lane);
        row[2] = T::get(linear.z, lane);
      }
    }
  }

#if defined(__x86_64__)
 private:
  /// Loads four numbers of each row, four rows to a register, so that lane 4 b + i lies in block b of
  /// register i.
  PBMPI_LANES static Vec3L<V> load_half_512_single(const Scalar* rows, const std::int32_t* at) {
    __m512 r[4];
    for (int i = 0; i < 4; ++i) {
      r[i] = _mm512_castps128_ps512(_mm_load_ps(rows + at[i]));
      r[i] = _mm512_insertf32x4(r[i], _mm_load_ps(rows + at[4 + i]), 1);
      r[i] = _mm512_insertf32x4(r[i], _mm_load_ps(rows + at[8 + i]), 2);
      r[i] = _mm512_insertf32x4(r[i], _mm_load_ps(rows + at[12 + i]), 3);
    }
    const __m512 low01 = _mm512_unpacklo_ps(r[0], r[1]), low23 = _mm512_unpacklo_ps(r[2], r[3]);
    const __m512 high01 = _mm512_unpackhi_ps(r[0], r[1]), high23 = _mm512_unpackhi_ps(r[2], r[3]);
    return {V(_mm512_shuffle_ps(low01, low23, 0x44)), V(_mm512_shuffle_ps(low01, low23, 0xee)),
            V(_mm512_shuffle_ps(high01, high23, 0x44))};
  }

  PBMPI_LANES static void store_half_512_single(Scalar* rows, const std::int32_t* at,
                                                const Vec3L<V>& linear) {
    const __m512 zero = _mm512_setzero_ps();
    const __m512 low01 = _mm512_unpacklo_ps(__m512(linear.x), __m512(linear.y));
    const __m512 high01 = _mm512_unpackhi_ps(__m512(linear.x), __m512(linear.y));
    const __m512 low23 = _mm512_unpacklo_ps(__m512(linear.z), zero);
    const __m512 high23 = _mm512_unpackhi_ps(__m512(linear.z), zero);
    const __m512 r[4] = {_mm512_shuffle_ps(low01, low23, 0x44), _mm512_shuffle_ps(low01, low23, 0xee),
                         _mm512_shuffle_ps(high01, high23, 0x44), _mm512_shuffle_ps(high01, high23, 0xee)};
    for (int i = 0; i < 4; ++i) {
      _mm_store_ps(rows + at[i], _mm512_castps512_ps128(r[i]));
      _mm_store_ps(rows + at[4 + i], _mm512_extractf32x4_ps(r[i], 1));
      _mm_store_ps(rows + at[8 + i], _mm512_extractf32x4_ps(r[i], 2));
      _mm_store_ps(rows + at[12 + i], _mm512_extractf32x4_ps(r[i], 3));
    }
  }

  /// Two rows to a register, such that the lanes come out in order: register i has the rows of these two
  /// lanes.
  static constexpr int pair_lanes[4][2] = {{0, 2}, {1, 3}, {4, 6}, {5, 7}};

  PBMPI_LANES static Vec3L<V> load_half_512_double(const Scalar* rows, const std::int32_t* at) {
    __m512d r[4];
    for (int i = 0; i < 4; ++i)
      r[i] = _mm512_insertf64x4(_mm512_castpd256_pd512(_mm256_load_pd(rows + at[pair_lanes[i][0]])),
                                _mm256_load_pd(rows + at[pair_lanes[i][1]]), 1);
    const __m512d even0 = _mm512_unpacklo_pd(r[0], r[1]), even4 = _mm512_unpacklo_pd(r[2], r[3]);
    const __m512d odd0 = _mm512_unpackhi_pd(r[0], r[1]), odd4 = _mm512_unpackhi_pd(r[2], r[3]);
    return {V(_mm512_shuffle_f64x2(even0, even4, 0x88)), V(_mm512_shuffle_f64x2(odd0, odd4, 0x88)),
            V(_mm512_shuffle_f64x2(even0, even4, 0xdd))};
  }

  PBMPI_LANES static void store_half_512_double(Scalar* rows, const std::int32_t* at,
                                                const Vec3L<V>& linear) {
    const __m512d zero = _mm512_setzero_pd();
    const __m512i first = _mm512_setr_epi64(0, 1, 8, 9, 2, 3, 10, 11);
    const __m512i second = _mm512_setr_epi64(4, 5, 12, 13, 6, 7, 14, 15);
    const __m512d xy[2] = {_mm512_unpacklo_pd(__m512d(linear.x), __m512d(linear.y)),
                           _mm512_unpackhi_pd(__m512d(linear.x), __m512d(linear.y))};
    const __m512d z[2] = {_mm512_unpacklo_pd(__m512d(linear.z), zero),
                          _mm512_unpackhi_pd(__m512d(linear.z), zero)};
    for (int i = 0; i < 4; ++i) {
      const __m512d r = _mm512_permutex2var_pd(xy[i % 2], i < 2 ? first : second, z[i % 2]);
      _mm256_store_pd(rows + at[pair_lanes[i][0]], _mm512_castpd512_pd256(r));
      _mm256_store_pd(rows + at[pair_lanes[i][1]], _mm512_extractf64x4_pd(r, 1));
    }
  }

  /// Loads two rows of eight floats to a register, so that the blocks of four come out in the lanes' order.
  PBMPI_LANES static Twist<V> load_512_single(const Scalar* rows, const std::int32_t* at) {
    __m512 r[8];
    for (int i = 0; i < 8; ++i) {
      const int first = i < 4 ? i : i + 4;
      r[i] = _mm512_insertf32x8(_mm512_castps256_ps512(_mm256_load_ps(rows + at[first])),
                                _mm256_load_ps(rows + at[first + 4]), 1);
    }
    // q[half][c], bodies 0 to 7 and 8 to 15: linear component c in the even blocks, the angular one in the
    // odd.
    __m512 q[2][3];
    for (int half = 0; half < 2; ++half) {
      const __m512* s = r + 4 * half;
      const __m512 low01 = _mm512_unpacklo_ps(s[0], s[1]), low23 = _mm512_unpacklo_ps(s[2], s[3]);
      const __m512 high01 = _mm512_unpackhi_ps(s[0], s[1]), high23 = _mm512_unpackhi_ps(s[2], s[3]);
      q[half][0] = _mm512_shuffle_ps(low01, low23, 0x44);
      q[half][1] = _mm512_shuffle_ps(low01, low23, 0xee);
      q[half][2] = _mm512_shuffle_ps(high01, high23, 0x44);
    }
    return {{V(_mm512_shuffle_f32x4(q[0][0], q[1][0], 0x88)), V(_mm512_shuffle_f32x4(q[0][1], q[1][1], 0x88)),
             V(_mm512_shuffle_f32x4(q[0][2], q[1][2], 0x88))},
            {V(_mm512_shuffle_f32x4(q[0][0], q[1][0], 0xdd)), V(_mm512_shuffle_f32x4(q[0][1], q[1][1], 0xdd)),
             V(_mm512_shuffle_f32x4(q[0][2], q[1][2], 0xdd))}};
  }

  PBMPI_LANES static void store_512_single(Scalar* rows, const std::int32_t* at, const Twist<V>& twist) {
    const __m512 zero = _mm512_setzero_ps();
    const __m512 c[8] = {__m512(twist.linear.x),  __m512(twist.linear.y),  __m512(twist.linear.z),  zero,
                         __m512(twist.angular.x), __m512(twist.angular.y), __m512(twist.angular.z), zero};
    const __m512i first = _mm512_setr_epi32(0, 1, 2, 3, 16, 17, 18, 19, 4, 5, 6, 7, 20, 21, 22, 23);
    const __m512i second = _mm512_setr_epi32(8, 9, 10, 11, 24, 25, 26, 27, 12, 13, 14, 15, 28, 29, 30, 31);
    for (int half = 0; half < 2; ++half) {
      __m512 q[4];
      for (int k = 0; k < 4; ++k) q[k] = _mm512_permutex2var_ps(c[k], half == 0 ? first : second, c[k + 4]);
      const __m512 low01 = _mm512_unpacklo_ps(q[0], q[1]), low23 = _mm512_unpacklo_ps(q[2], q[3]);
      const __m512 high01 = _mm512_unpackhi_ps(q[0], q[1]), high23 = _mm512_unpackhi_ps(q[2], q[3]);
      const __m512 r[4] = {_mm512_shuffle_ps(low01, low23, 0x44), _mm512_shuffle_ps(low01, low23, 0xee),
                           _mm512_shuffle_ps(high01, high23, 0x44), _mm512_shuffle_ps(high01, high23, 0xee)};
      for (int k = 0; k < 4; ++k) {
        _mm256_store_ps(rows + at[8 * half + k], _mm512_castps512_ps256(r[k]));
        _mm256_store_ps(rows + at[8 * half + k + 4], _mm512_extractf32x8_ps(r[k], 1));
      }
    }
  }

  PBMPI_LANES static void transpose(const __m512d* r, __m512d* c) {
    for (int odd = 0; odd < 2; ++odd) {
      __m512d t[4];
      for (int k = 0; k < 4; ++k)
        t[k] = odd ? _mm512_unpackhi_pd(r[2 * k], r[2 * k + 1]) : _mm512_unpacklo_pd(r[2 * k], r[2 * k + 1]);
      const __m512d a = _mm512_shuffle_f64x2(t[0], t[1], 0x88), b = _mm512_shuffle_f64x2(t[2], t[3], 0x88);
      const __m512d d = _mm512_shuffle_f64x2(t[0], t[1], 0xdd), e = _mm512_shuffle_f64x2(t[2], t[3], 0xdd);
      c[odd] = _mm512_shuffle_f64x2(a, b, 0x88);
      c[odd + 4] = _mm512_shuffle_f64x2(a, b, 0xdd);
      c[odd + 2] = _mm512_shuffle_f64x2(d, e, 0x88);
      c[odd + 6] = _mm512_shuffle_f64x2(d, e, 0xdd);
    }
  }

  PBMPI_LANES static Twist<V> load_512_double(const Scalar* rows, const std::int32_t* at) {
    __m512d r[8], c[8];
    for (int i = 0; i < 8; ++i) r[i] = _mm512_load_pd(rows + at[i]);
    transpose(r, c);
    return {{V(c[0]), V(c[1]), V(c[2])}, {V(c[4]), V(c[5]), V(c[6])}};
  }

  PBMPI_LANES static void store_512_double(Scalar* rows, const std::int32_t* at, const Twist<V>& twist) {
    const __m512d zero = _mm512_setzero_pd();
    const __m512d c[8] = {__m512d(twist.linear.x),  __m512d(twist.linear.y),  __m512d(twist.linear.z),  zero,
                          __m512d(twist.angular.x), __m512d(twist.angular.y), __m512d(twist.angular.z), zero};
    __m512d r[8];
    transpose(c, r);
    for (int i = 0; i < 8; ++i) _mm512_store_pd(rows + at[i], r[i]);
  }
#endif
};

/// A row for each lane of each slot of bodies.
template <class T>
class TwistRows {
 public:
  using V = typename T::V;
  using Scalar = typename T::Scalar;

  explicit TwistRows(int num_slots) : rows_(static_cast<std::size_t>(num_slots * T::num_lanes)) {}

  static std::int32_t index(int slot, int lane) { return (slot * T::num_lanes + lane) * twist_row_size; }

  PBMPI_LANES Twist<V> gather(const std::int32_t* at) const {
    return TwistTranspose<T>::load(rows_.data()->numbers, at);
  }
  PBMPI_LANES void scatter(const std::int32_t* at, const Twist<V>& twist) {
    TwistTranspose<T>::store(rows_.data()->numbers, at, twist);
  }
  /// The linear velocities only.
  PBMPI_LANES Vec3L<V> gather_linear(const std::int32_t* at) const {
    return TwistTranspose<T>::load_half(rows_.data()->numbers, at);
  }
  PBMPI_LANES void scatter_linear(const std::int32_t* at, const Vec3L<V>& linear) {
    TwistTranspose<T>::store_half(rows_.data()->numbers, at, linear);
  }
  /// Writes all lanes of a slot.
  PBMPI_LANES void set_slot(int slot, const Twist<V>& twist) { scatter(slot_index(slot).at, twist); }
  PBMPI_LANES Twist<V> slot(int slot) const { return gather(slot_index(slot).at); }

 private:
  struct SlotIndex {
    std::int32_t at[T::num_lanes];
  };
  PBMPI_LANES static SlotIndex slot_index(int slot) {
    SlotIndex index;
    for (int lane = 0; lane < T::num_lanes; ++lane) index.at[lane] = TwistRows::index(slot, lane);
    return index;
  }
  struct alignas(twist_row_size * sizeof(Scalar)) Row {
    Scalar numbers[twist_row_size] = {};
  };
  std::vector<Row> rows_;
};

}  // namespace pbmpi::solver
