/// The progress bar of a run: frames done, frames/s and time left, on one line of stderr.
#pragma once

#include <cstdint>
#include <ostream>

#include "app/common/options.h"
#include "stepping/frame.h"

namespace pbmpi::app {

/// True if a bar should be drawn: always, or automatic on a terminal.
bool wants_progress(ProgressMode mode, bool quiet);

/// Redraws at most ten times a second.
class ProgressBar final : public stepping::FrameObserver {
 public:
  /// `first_frame`: frames done before the run.
  ProgressBar(std::ostream& out, std::int64_t num_frames, std::int64_t first_frame = 0);
  ~ProgressBar() override;  ///< ends the line
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  void frame_done(const stepping::FrameRecord& frame) override;

 private:
  void draw(std::int64_t done, double now_s);

  std::ostream& out_;
  std::int64_t num_frames_, first_frame_;
  double start_s_;
  double last_draw_s_ = 0;
  bool drawn_ = false;
};

}  // namespace pbmpi::app
