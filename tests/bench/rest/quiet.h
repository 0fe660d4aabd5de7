/// What a tolerance saves where little moves, and what it costs where all does.
#pragma once

#include "bench/subjects.h"

namespace pbmpi::bench {

/// Steps the subject, awake, for so long, and goes on from there twice, with all substeps for all islands and
/// with this tolerance, some frames of each in turn. Prints the ratios without over with it of CPU time and
/// of visits of rows, and how far both come from a reference with four times the substeps and the sweeps.
void compare_quiet(const Subject& subject, double from_s, double tolerance_m);

}  // namespace pbmpi::bench
