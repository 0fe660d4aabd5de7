#include "app/pbmpi/estimate_monitor.h"

namespace pbmpi::app {

void EstimateMonitor::poses(std::int64_t frame, stepping::PoseKind kind,
                            std::span<const model::Vec3> position, std::span<const model::Quat> orientation) {
  if (frame < num_warmup_) return;
  if (kind == stepping::PoseKind::estimate) {
    position_.assign(position.begin(), position.end());
    orientation_.assign(orientation.begin(), orientation.end());
  } else {
    errors_.append(analysis::compare_bodies({position_, orientation_}, {position, orientation}));
  }
}

analysis::ErrorSummary EstimateMonitor::position_defect() const {
  return analysis::summarize_positions(errors_.body_position_m);
}

analysis::ErrorSummary EstimateMonitor::orientation_defect() const {
  return analysis::summarize_orientations(errors_.body_orientation_rad);
}

}  // namespace pbmpi::app
