/// Progress on one line that is redrawn in place.
#pragma once

#include <cstddef>
#include <functional>
#include <ostream>
#include <string>

#include "app/common/options.h"

namespace pbmpi::app {

/// Should progress be drawn on stderr: always, or automatic on a terminal unless the program is quiet?
bool wants_progress(const CommonOptions& common);

/// Redraws at most ten times a second.
class ProgressLine {
 public:
  /// `out` is borrowed.
  explicit ProgressLine(std::ostream& out) : out_(out) {}
  ~ProgressLine();  ///< ends the line
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  /// Draws the result of `text` if a tenth of a second has passed, or this `is_last`.
  void show(bool is_last, const std::function<std::string()>& text);

 private:
  std::ostream& out_;
  double last_s_ = 0;
  std::size_t width_ = 0;  ///< of the text now on the line
};

}  // namespace pbmpi::app
