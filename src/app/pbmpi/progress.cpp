#include "app/pbmpi/progress.h"

#include <fmt/core.h>

#include "core/clock.h"

namespace pbmpi::app {
namespace {

constexpr int bar_width = 30;

}  // namespace

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

RunProgress::RunProgress(std::ostream& out, ProgressForm form, std::int64_t num_frames,
                         std::int64_t first_frame)
    : line_(out, form),
      form_(form),
      num_frames_(num_frames),
      first_frame_(first_frame),
      start_s_(core::now_s()) {}

void RunProgress::frame_done(const stepping::FrameRecord& frame) {
  line_.show(frame.frame + 1 == num_frames_, [&] { return text(frame.frame + 1); });
}

std::string RunProgress::text(std::int64_t done) const {
  const double elapsed_s = core::now_s() - start_s_;
  const double rate_hz = elapsed_s > 0 ? static_cast<double>(done - first_frame_) / elapsed_s : 0;
  const double left_s = rate_hz > 0 ? static_cast<double>(num_frames_ - done) / rate_hz : 0;
  const std::string numbers =
      fmt::format("frame {}/{}  {:.1f} frames/s  ETA {:.0f} s", done, num_frames_, rate_hz, left_s);
  if (form_ == ProgressForm::lines) return "pbmpi: " + numbers;
  const auto filled = static_cast<std::size_t>(bar_width * done / num_frames_);
  const std::string bar = std::string(filled, '#') + std::string(bar_width - filled, '.');
  return "[" + bar + "] " + numbers;
}

}  // namespace pbmpi::app
