#include "app/common/progress_line.h"

#include <unistd.h>

#include <algorithm>

#include "core/clock.h"

namespace pbmpi::app {
namespace {

constexpr double redraw_interval_s = 0.1;

}  // namespace

bool wants_progress(const CommonOptions& common) {
  if (common.progress == ProgressMode::automatic) return !common.quiet && isatty(STDERR_FILENO) != 0;
  return common.progress == ProgressMode::always;
}

ProgressLine::~ProgressLine() {
  if (width_ > 0) out_ << '\n' << std::flush;
}

void ProgressLine::show(bool is_last, const std::function<std::string()>& text) {
  const double now_s = core::now_s();
  if (now_s - last_s_ < redraw_interval_s && !is_last) return;
  const std::string line = text();
  const std::size_t shorter = width_ > line.size() ? width_ - line.size() : 0;
  out_ << '\r' << line << std::string(shorter, ' ') << std::flush;
  width_ = std::max(line.size(), std::size_t{1});
  last_s_ = now_s;
}

}  // namespace pbmpi::app
