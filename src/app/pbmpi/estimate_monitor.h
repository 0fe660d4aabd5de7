/// Learns on root how far the estimates of FEEC were from the precise poses.
#pragma once

#include <vector>

#include "analysis/error_bands.h"
#include "analysis/pose_errors.h"
#include "stepping/frame.h"

namespace pbmpi::app {

/// A consumer like any other: it gets the estimate of a frame, and later the precise poses. Keeps 16 bytes
/// per body and measured frame (the file of the run, if there is one, takes nine times as much).
class EstimateMonitor final : public stepping::PoseConsumer {
 public:
  explicit EstimateMonitor(std::int64_t num_warmup) : num_warmup_(num_warmup) {}

  void poses(std::int64_t frame, stepping::PoseKind kind, std::span<const model::Vec3> position,
             std::span<const model::Quat> orientation) override;

  /// Over all bodies of the measured frames. Empty except on root.
  analysis::ErrorSummary position_defect() const;     ///< [m]
  analysis::ErrorSummary orientation_defect() const;  ///< [rad]

 private:
  std::int64_t num_warmup_;
  std::vector<model::Vec3> position_;  ///< estimated
  std::vector<model::Quat> orientation_;
  analysis::PoseErrors errors_;
};

}  // namespace pbmpi::app
