#include "app/pbmpi/progress.h"

#include <fmt/core.h>

#include "core/clock.h"

namespace pbmpi::app {
namespace {

constexpr int bar_width = 30;

}  // namespace

ProgressBar::ProgressBar(std::ostream& out, std::int64_t num_frames, std::int64_t first_frame)
    : line_(out), num_frames_(num_frames), first_frame_(first_frame), start_s_(core::now_s()) {}

void ProgressBar::frame_done(const stepping::FrameRecord& frame) {
  line_.show(frame.frame + 1 == num_frames_, [&] { return text(frame.frame + 1); });
}

std::string ProgressBar::text(std::int64_t done) const {
  const double elapsed_s = core::now_s() - start_s_;
  const double rate_hz = elapsed_s > 0 ? static_cast<double>(done - first_frame_) / elapsed_s : 0;
  const double left_s = rate_hz > 0 ? static_cast<double>(num_frames_ - done) / rate_hz : 0;
  const auto filled = static_cast<std::size_t>(bar_width * done / num_frames_);
  const std::string bar = std::string(filled, '#') + std::string(bar_width - filled, '.');
  return fmt::format("[{}] frame {}/{}  {:.1f} frames/s  ETA {:.0f} s", bar, done, num_frames_, rate_hz,
                     left_s);
}

}  // namespace pbmpi::app
