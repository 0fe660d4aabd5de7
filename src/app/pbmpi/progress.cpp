#include "app/pbmpi/progress.h"

#include <fmt/core.h>

#include "core/clock.h"

namespace pbmpi::app {
namespace {

constexpr int bar_width = 30;

}  // namespace

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
