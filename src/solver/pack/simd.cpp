#include "solver/pack/simd.h"

#include <algorithm>
#include <array>

#include "core/error.h"
#include "solver/pack/pack_instances.h"

namespace pbmpi::solver {

using stepping::Precision;
using stepping::Simd;

namespace {

struct BuiltPack {
  Simd simd;
  MakePack *make_double, *make_single;
};

/// The packs of this build (PBMPI_SIMD in CMakeLists.txt), the widest last.
constexpr auto built_packs = std::to_array<BuiltPack>({
#ifdef PBMPI_PACK_baseline
    {Simd::off, make_double_off, make_single_off},
    {Simd::sse2, make_double_sse2, make_single_sse2},
#endif
#ifdef PBMPI_PACK_avx2
    {Simd::avx2, make_double_avx2, make_single_avx2},
#endif
#ifdef PBMPI_PACK_avx512
    {Simd::avx512, make_double_avx512, make_single_avx512},
#endif
});

bool runs_here(Simd simd) {
#if defined(__x86_64__)
  if (simd == Simd::avx2) return __builtin_cpu_supports("avx2") != 0;
  if (simd == Simd::avx512)
    return __builtin_cpu_supports("avx512f") != 0 && __builtin_cpu_supports("avx512dq") != 0 &&
           __builtin_cpu_supports("avx512vl") != 0 && __builtin_cpu_supports("avx512bw") != 0;
#endif
  return simd != Simd::automatic;
}

}  // namespace

bool has_simd(Simd simd) {
  if (simd == Simd::automatic) return best_simd() != Simd::automatic;
  return runs_here(simd) && std::ranges::find(built_packs, simd, &BuiltPack::simd) != built_packs.end();
}

Simd best_simd() {
  const auto best = std::find_if(built_packs.rbegin(), built_packs.rend(),
                                 [](const BuiltPack& pack) { return runs_here(pack.simd); });
  return best == built_packs.rend() ? Simd::automatic : best->simd;
}

int num_lanes(Simd simd, Precision precision) {
  if (simd == Simd::automatic) simd = best_simd();
  const int doubles = simd == Simd::avx512 ? 8 : (simd == Simd::avx2 ? 4 : (simd == Simd::sse2 ? 2 : 1));
  return simd == Simd::off || precision == Precision::double_ ? doubles : 2 * doubles;
}

std::unique_ptr<Pack> make_pack(std::span<const PackedWorld> worlds, Simd simd, Precision precision) {
  if (simd == Simd::automatic) simd = best_simd();
  const auto found = std::ranges::find(built_packs, simd, &BuiltPack::simd);
  if (found == built_packs.end())
    throw core::RunError("internal error: make_pack() with an instruction set that this build or CPU lacks");
  return (precision == Precision::single ? found->make_single : found->make_double)(worlds);
}

}  // namespace pbmpi::solver
