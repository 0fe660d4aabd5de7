/// The progress of a run: frames done, frames/s and time left, as a bar or in lines.
#pragma once

#include <cstdint>
#include <ostream>
#include <string>

#include "app/common/progress_line.h"
#include "stepping/frame.h"

namespace pbmpi::app {

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
