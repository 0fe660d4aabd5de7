/// Joints that broke in recorded runs, as the files' events tell.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "io/run/run_data.h"

namespace pbmpi::app {

struct BrokenJoint {
  std::int64_t frame = 0, step = 0;
  std::string joint;  ///< "world 0: 'car.front_left_suspension'"
};

/// What an event ("frame 6: joint_broken: world 0: 'x' broke in step 19") tells; nothing if it is another.
std::optional<BrokenJoint> broken_joint(const std::string& event);

/// In the frames that both runs have, in the order in which they broke.
struct BreakComparison {
  std::int64_t in_both = 0;  ///< in the same step or not
  std::vector<BrokenJoint> in_run_only, in_reference_only;
};
BreakComparison compare_breaks(const io::RunData& run, const io::RunData& reference);

}  // namespace pbmpi::app
