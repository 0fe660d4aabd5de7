#include "analysis/error_table.h"

namespace pbmpi::analysis {

ErrorTable summarize(const PoseErrors& errors) {
  ErrorTable table = {
      summarize_positions(errors.body_position_m), summarize_orientations(errors.body_orientation_rad),
      summarize_positions(errors.joint_position_m), summarize_orientations(errors.joint_orientation_rad)};
  for (ErrorSummary* joints : {&table.joint_position, &table.joint_orientation}) {
    joints->broken = errors.broken_joints;
    joints->count += errors.broken_joints;
  }
  return table;
}

}  // namespace pbmpi::analysis
