/// Root's choice between waiting for poses that are due, and colliding in its own spaces first: pure data,
/// without communication. It affects time only, never a result.
#pragma once

#include <vector>

namespace pbmpi::mpi {

/// Seconds of a rank's step.
struct StepPace {
  double collide_s = 0;  ///< until root's verdict is needed
  double solve_s = 0;    ///< from the verdict until poses are posted
};

/// Root's verdict needs the poses of all ranks. While root collides it cannot look for messages, and ranks
/// whose poses came early wait for the verdict; while root waits for poses, its own collision is delayed.
/// Steps resemble the steps before, so the last step predicts which choice makes this one shorter.
class RootSchedule {
 public:
  explicit RootSchedule(int num_ranks) : ranks_(static_cast<std::size_t>(num_ranks)) {}

  /// All ranks begin a step at `now_s`.
  void start_all(double now_s);
  /// Root sends the verdict of the step, after a search that took `search_s`.
  void note_verdict(double now_s, double search_s);
  /// The pace of root's own last step.
  void note_own(const StepPace& own) { own_ = own; }
  /// The poses of another rank arrived between `after_s` and `by_s`; `pace`: that of its last step.
  void note_arrival(int rank, double after_s, double by_s, const StepPace& pace);

  /// Predicted time at which the last of the other ranks' poses arrive.
  double expected_s() const;
  /// Does the step end sooner if root waits for the poses from `now_s` on?
  bool should_wait(double now_s) const;

 private:
  struct Rank {
    double began_s = 0;  ///< when its step began: right after it posted its poses
    StepPace pace;
  };
  double expected_s(const Rank& rank) const;

  std::vector<Rank> ranks_;  ///< [num_ranks]; root's entry is not used
  StepPace own_;
  double verdict_s_ = 0;  ///< when the last verdict was sent
  double search_s_ = 0;   ///< how long its search took
};

}  // namespace pbmpi::mpi
