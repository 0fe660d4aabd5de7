/// --describe: what a run would do, without running it.
#pragma once

#include <string>

#include "app/pbmpi/work.h"

namespace pbmpi::app {

/// The resolved scene, the step plan with the reason for each pass, who owns what over `num_ranks` ranks, and
/// estimates of memory (measured on the first world) and file size. Builds every world once, one at a time.
std::string describe(const Work& work, int num_ranks);

}  // namespace pbmpi::app
