#include "app/pbmpi/progress.h"

#include <unistd.h>

#include <cstdio>

namespace pbmpi::app {
namespace {

constexpr double redraw_interval_s = 0.1;
constexpr int bar_width = 30;

}  // namespace

bool wants_progress(ProgressMode mode, bool quiet) {
  if (mode == ProgressMode::automatic) return !quiet && isatty(STDERR_FILENO) != 0;
  return mode == ProgressMode::always;
}

ProgressBar::ProgressBar(std::ostream& out, std::int64_t num_frames, std::int64_t first_frame)
    : out_(out), num_frames_(num_frames), first_frame_(first_frame), start_s_(core::now_s()) {}

ProgressBar::~ProgressBar() {
  if (drawn_) out_ << '\n';
}

void ProgressBar::frame_done(const stepping::FrameRecord& frame) {
  const double now = core::now_s();
  const bool last = frame.frame + 1 == num_frames_;
  if (now - last_draw_s_ >= redraw_interval_s || last) draw(frame.frame + 1, now);
}

void ProgressBar::draw(std::int64_t done, double now_s) {
  const double elapsed_s = now_s - start_s_;
  const double rate_hz = elapsed_s > 0 ? static_cast<double>(done - first_frame_) / elapsed_s : 0;
  const double left_s = rate_hz > 0 ? static_cast<double>(num_frames_ - done) / rate_hz : 0;
  const int filled = static_cast<int>(bar_width * done / num_frames_);
  const std::string bar = std::string(static_cast<std::size_t>(filled), '#') +
                          std::string(static_cast<std::size_t>(bar_width - filled), '.');
  char line[128];
  std::snprintf(line, sizeof line, "\r[%s] frame %lld/%lld  %.1f frames/s  ETA %.0f s ", bar.c_str(),
                static_cast<long long>(done), static_cast<long long>(num_frames_), rate_hz, left_s);
  out_ << line << std::flush;
  drawn_ = true;
  last_draw_s_ = now_s;
}

}  // namespace pbmpi::app
