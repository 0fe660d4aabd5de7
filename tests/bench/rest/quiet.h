/// Measures what a tolerance saves where little moves, and what it costs where everything does.
#pragma once

#include "bench/subjects.h"

namespace pbmpi::bench {

/// Steps the subject, awake, up to `from_s`, and continues from there twice, with all substeps for all
/// islands and with this tolerance, alternating after some frames. Prints the ratios (without to with the
/// tolerance) of CPU time and of visits of rows, and the distance of both from a reference with four times
/// the substeps and the sweeps.
void compare_quiet(const Subject& subject, double from_s, double tolerance_m);

}  // namespace pbmpi::bench
