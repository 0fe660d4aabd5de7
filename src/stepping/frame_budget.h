/// How long a frame may take.
#pragma once

namespace pbmpi::stepping {

/// A tenth of a frame at 30 Hz (paper, section 4.1), unless a run chooses another.
inline constexpr double default_frame_budget_s = 0.1 / 30;

}  // namespace pbmpi::stepping
