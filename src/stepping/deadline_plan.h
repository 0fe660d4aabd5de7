/// What an estimate that is due at some time can afford, judged by what the last frames took.
#pragma once

#include <cstddef>
#include <deque>

namespace pbmpi::stepping {

/// Plans on one rank. A step is expected to take as long as the slowest of its kind in the last frames, and
/// what is not known yet as no time at all: the first frames may come late. A tenth of the time is left for
/// the messages.
class DeadlinePlan {
 public:
  /// `deadline_s`: from the start of the frame until the estimate is due.
  explicit DeadlinePlan(double deadline_s) : due_s_(share_for_steps * deadline_s) {}

  /// `spent_s` into the frame: is there time for so many steps yet?
  bool fits(double spent_s, int precise_steps, int coarse_steps) const {
    return spent_s + precise_steps * longest(precise_s_) + coarse_steps * longest(coarse_s_) <= due_s_;
  }

  /// What a step took in this frame.
  void note_precise(double step_s) { note(step_s, precise_s_); }
  void note_coarse(double step_s) { note(step_s, coarse_s_); }
  /// There was no coarse step: what the last ones took counts a tenth less from now on, so that a slow frame
  /// does not end them for good.
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
