/// The packs that exist; those of an instruction set are compiled in a file of their own.
#pragma once

#include <memory>
#include <span>

#include "solver/pack/pack.h"

namespace pbmpi::solver {

using MakePack = std::unique_ptr<Pack>(std::span<const PackedWorld> worlds);

MakePack make_double_off, make_double_sse2, make_double_avx2, make_double_avx512;
MakePack make_single_off, make_single_sse2, make_single_avx2, make_single_avx512;

}  // namespace pbmpi::solver
