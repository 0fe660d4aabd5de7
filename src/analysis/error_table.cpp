#include "analysis/error_table.h"

namespace pbmpi::analysis {

ErrorTable summarize(const PoseErrors& errors) {
  return {summarize_positions(errors.body_position_m), summarize_orientations(errors.body_orientation_rad),
          summarize_positions(errors.joint_position_m), summarize_orientations(errors.joint_orientation_rad)};
}

}  // namespace pbmpi::analysis
