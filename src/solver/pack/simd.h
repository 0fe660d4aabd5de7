/// Which vector instructions the lanes use; chosen when the program runs.
#pragma once

#include <memory>
#include <span>
#include <string_view>

#include "solver/pack/pack.h"
#include "stepping/stepper.h"

namespace pbmpi::solver {

/// The widest instruction set that this build and this machine have; `automatic` where there is none.
stepping::Simd best_simd();
bool has_simd(stepping::Simd simd);

/// Lanes of a register: `single` 4, 8, 16 and `double` 2, 4, 8 for SSE2, AVX2, AVX-512; 1 for off.
int num_lanes(stepping::Simd simd, stepping::Precision precision);

/// Makes a pack of these worlds. Their erp, cfm and contact laws must be equal.
std::unique_ptr<Pack> make_pack(std::span<const PackedWorld> worlds, stepping::Simd simd,
                                stepping::Precision precision);

}  // namespace pbmpi::solver
