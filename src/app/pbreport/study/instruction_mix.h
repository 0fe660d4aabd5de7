/// Classes of instructions, and the paper's statements about them in section 3.3.
#pragma once

#include <array>
#include <vector>

#include "app/pbreport/study/paper_verdict.h"

namespace pbmpi::app {

inline constexpr std::array<const char*, 5> mix_names = {"floating point", "integer", "branch", "store",
                                                         "load"};
/// Shares of the operations, in the order of mix_names.
using InstructionMix = std::array<double, mix_names.size()>;
inline constexpr InstructionMix paper_mix = {0.34, 0.25, 0.06, 0.05, 0.30};

/// All zero without scenes.
InstructionMix mean_mix(const std::vector<InstructionMix>& scenes);

/// Undecidable without scenes.
PaperVerdict judge_mix(const std::vector<InstructionMix>& scenes);
/// `shares`: collision detection's share of the instructions of each scene. Undecidable without scenes.
PaperVerdict judge_collision_share(const std::vector<double>& shares);

}  // namespace pbmpi::app
