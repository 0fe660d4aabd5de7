#include "app/common/progress_line.h"

#include <unistd.h>

#include <algorithm>

#include "core/clock.h"
#include "core/system/awaited.h"

namespace pbmpi::app {
namespace {

constexpr double redraw_interval_s = 0.1;

}  // namespace

ProgressForm progress_form(const CommonOptions& common) {
  if (common.progress == ProgressMode::always) return ProgressForm::bar;
  if (common.progress == ProgressMode::never || common.quiet) return ProgressForm::none;
  return isatty(STDERR_FILENO) != 0 ? ProgressForm::bar : ProgressForm::lines;
}

void tell_of_slow_starts(const CommonOptions& common) {
  constexpr int slow_s = 2;
  if (progress_form(common) != ProgressForm::none) core::set_first_word(slow_s);
}

ProgressLine::ProgressLine(std::ostream& out, ProgressForm form, double line_interval_s)
    : out_(out),
      form_(form),
      line_interval_s_(line_interval_s),
      last_s_(form == ProgressForm::lines ? core::now_s() : 0) {}

ProgressLine::~ProgressLine() {
  if (width_ > 0) out_ << '\n' << std::flush;
}

void ProgressLine::show(bool is_last, const std::function<std::string()>& text) {
  const double now_s = core::now_s();
  if (form_ == ProgressForm::lines) {
    if (now_s - last_s_ < line_interval_s_) return;
    out_ << text() << '\n' << std::flush;
    last_s_ = now_s;
    return;
  }
  if (now_s - last_s_ < redraw_interval_s && !is_last) return;
  const std::string line = text();
  const std::size_t shorter = width_ > line.size() ? width_ - line.size() : 0;
  out_ << '\r' << line << std::string(shorter, ' ') << std::flush;
  width_ = std::max(line.size(), std::size_t{1});
  last_s_ = now_s;
}

}  // namespace pbmpi::app
