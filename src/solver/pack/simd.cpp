#include "solver/pack/simd.h"

#include "core/error.h"
#include "solver/pack/pack_instances.h"

namespace pbmpi::solver {

using stepping::Precision;
using stepping::Simd;

bool has_simd(Simd simd) {
  switch (simd) {
    case Simd::off:
    case Simd::sse2:
      return true;  // part of x86-64; elsewhere registers of the same width, such as arm64's
#if defined(__x86_64__)
    case Simd::avx2:
      return __builtin_cpu_supports("avx2") != 0;
    case Simd::avx512:
      return __builtin_cpu_supports("avx512f") != 0 && __builtin_cpu_supports("avx512dq") != 0 &&
             __builtin_cpu_supports("avx512vl") != 0 && __builtin_cpu_supports("avx512bw") != 0;
#else
    case Simd::avx2:
    case Simd::avx512:
      return false;
#endif
    case Simd::automatic:
      return true;
  }
  return false;
}

Simd best_simd() {
  if (has_simd(Simd::avx512)) return Simd::avx512;
  return has_simd(Simd::avx2) ? Simd::avx2 : Simd::sse2;
}

int num_lanes(Simd simd, Precision precision) {
  if (simd == Simd::automatic) return num_lanes(best_simd(), precision);
  const int doubles = simd == Simd::avx512 ? 8 : (simd == Simd::avx2 ? 4 : (simd == Simd::sse2 ? 2 : 1));
  return simd == Simd::off || precision == Precision::double_ ? doubles : 2 * doubles;
}

std::unique_ptr<Pack> make_pack(std::span<const PackedWorld> worlds, Simd simd, Precision precision) {
  const bool single = precision == Precision::single;
  switch (simd) {
    case Simd::off:
      return single ? make_single_off(worlds) : make_double_off(worlds);
    case Simd::sse2:
      return single ? make_single_sse2(worlds) : make_double_sse2(worlds);
#if defined(__x86_64__)
    case Simd::avx2:
      return single ? make_single_avx2(worlds) : make_double_avx2(worlds);
    case Simd::avx512:
      return single ? make_single_avx512(worlds) : make_double_avx512(worlds);
#else
    case Simd::avx2:
    case Simd::avx512:
      throw core::RunError("internal error: make_pack() with an instruction set that this CPU lacks");
#endif
    case Simd::automatic:
      break;
  }
  return make_pack(worlds, best_simd(), precision);
}

}  // namespace pbmpi::solver
