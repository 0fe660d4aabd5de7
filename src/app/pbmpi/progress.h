/// The progress of a run: frames done, frames/s and time left, as a bar or in lines; and how far its
/// estimates are off.
#pragma once

#include <cstdint>
#include <ostream>
#include <string>
#include <vector>

#include "analysis/error_bands.h"
#include "analysis/pose_errors.h"
#include "app/common/progress_line.h"
#include "stepping/frame.h"

namespace pbmpi::app {

/// Learns on root how far the estimates of FEEC were from the precise poses. A consumer like any other: it
/// gets the estimate of a frame, and later the precise poses. Keeps 16 bytes per body and measured frame (the
/// file of the run, if there is one, takes nine times as much).
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

class RunProgress final : public stepping::FrameObserver {
 public:
  /// `first_frame`: frames done before the run.
  RunProgress(std::ostream& out, ProgressForm form, std::int64_t num_frames, std::int64_t first_frame = 0);
  void frame_done(const stepping::FrameRecord& frame) override;

 private:
  std::string text(std::int64_t done) const;

  ProgressLine line_;
  ProgressForm form_;
  std::int64_t num_frames_, first_frame_;
  double start_s_;
};

}  // namespace pbmpi::app
