/// Progress on stderr: one line that is redrawn in place, or a line now and then where that cannot be.
#pragma once

#include <cstddef>
#include <functional>
#include <ostream>
#include <string>

#include "app/common/options.h"

namespace pbmpi::app {

/// How progress is shown: as a bar where it is always wanted or stderr is a terminal, else, as under mpirun,
/// in lines. A quiet program shows it only if it is always wanted.
enum class ProgressForm { none, bar, lines };
ProgressForm progress_form(const CommonOptions& common);

/// From now on this process says on stderr what it waits for where that lasts over two seconds, unless no
/// progress is to be shown: a run or a study that begins slowly.
void tell_of_slow_starts(const CommonOptions& common);

/// A bar is redrawn at most ten times a second.
class ProgressLine {
 public:
  /// `out` is borrowed. `form`: bar or lines.
  ProgressLine(std::ostream& out, ProgressForm form, double line_interval_s = 10);
  ~ProgressLine();  ///< ends the bar's line
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  /// Shows the result of `text` if it is time, or a bar's `is_last`.
  void show(bool is_last, const std::function<std::string()>& text);

 private:
  std::ostream& out_;
  ProgressForm form_;
  double line_interval_s_, last_s_;
  std::size_t width_ = 0;  ///< of the text now on the line
};

}  // namespace pbmpi::app
