/// The progress bar of a run: frames done, frames/s and time left, on one line of stderr.
#pragma once

#include <cstdint>
#include <ostream>
#include <string>

#include "app/common/progress_line.h"
#include "stepping/frame.h"

namespace pbmpi::app {

class ProgressBar final : public stepping::FrameObserver {
 public:
  /// `first_frame`: frames done before the run.
  ProgressBar(std::ostream& out, std::int64_t num_frames, std::int64_t first_frame = 0);
  void frame_done(const stepping::FrameRecord& frame) override;

 private:
  std::string text(std::int64_t done) const;

  ProgressLine line_;
  std::int64_t num_frames_, first_frame_;
  double start_s_;
};

}  // namespace pbmpi::app
