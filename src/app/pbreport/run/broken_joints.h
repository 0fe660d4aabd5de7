/// Joints that broke in recorded runs, from the files' events.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/run/run_data.h"

namespace pbmpi::app {

struct BrokenJoint {
  std::int64_t frame = 0, step = 0;
  std::string joint;  ///< "world 0: 'car.front_left_suspension'"
};

/// The joints that broke, in order. Leaves out those for which the file had no row, and all in a file before
/// layout 1.2, which does not tell which they are.
std::vector<BrokenJoint> broken_joints(const io::RunData& run);

/// Joints that broke in the frames that both runs have, in the order in which they broke.
struct BreakComparison {
  std::int64_t in_both = 0;  ///< in the same step or in different ones
  std::vector<BrokenJoint> in_run_only, in_reference_only;
  std::int64_t unknown_in_run = 0, unknown_in_reference = 0;  ///< left out by broken_joints()
};
BreakComparison compare_breaks(const io::RunData& run, const io::RunData& reference);

}  // namespace pbmpi::app
