/// What an estimate with a deadline can afford, judged by the times of the last frames.
#pragma once

#include <cstddef>
#include <deque>

namespace pbmpi::stepping {

/// Plans on one rank. A step is expected to take as long as the slowest of its kind in the last frames, and
/// no time at all while none is known: the first frames may come late. A tenth of the time is left for the
/// messages.
class DeadlinePlan {
 public:
  /// `deadline_s`: from the start of the frame until the estimate is due.
  explicit DeadlinePlan(double deadline_s) : due_s_(share_for_steps * deadline_s) {}

  /// Is there still time for so many steps, `spent_s` after the start of the frame?
  bool fits(double spent_s, int precise_steps, int coarse_steps) const {
    return spent_s + precise_steps * longest(precise_s_) + coarse_steps * longest(coarse_s_) <= due_s_;
  }

  /// Note how long a step took in this frame.
  void note_precise(double step_s) { note(step_s, precise_s_); }
  void note_coarse(double step_s) { note(step_s, coarse_s_); }
  /// There was no coarse step: the times of the last ones are reduced by a tenth, so that a slow frame does
  /// not end coarse steps for good.
  void skip_coarse() {
    for (double& step_s : coarse_s_) step_s *= 0.9;
  }

 private:
  static constexpr double share_for_steps = 0.9;
  static constexpr std::size_t window = 3;  ///< frames

  static double longest(const std::deque<double>& seconds) {
    double most = 0;
    for (const double one : seconds) most = one > most ? one : most;
    return most;
  }
  static void note(double seconds, std::deque<double>& last) {
    last.push_back(seconds);
    if (last.size() > window) last.pop_front();
  }

  double due_s_;
  std::deque<double> precise_s_, coarse_s_;
};

}  // namespace pbmpi::stepping
