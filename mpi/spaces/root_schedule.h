/// Whether root waits for poses that are due, or collides in its own spaces first: pure data, known to no
/// communicator. It decides about time only, never about a result.
#pragma once

#include <vector>

namespace pbmpi::mpi {

/// What a rank's step consists of [s].
struct StepPace {
  double collide_s = 0;  ///< until root's verdict is needed
  double solve_s = 0;    ///< from the verdict until poses are posted
};

/// Root's verdict needs the poses of all ranks. While root collides it cannot look for them, and the ranks
/// wait for as long as they came too early; while it waits for them its own collision stands still. Steps
/// resemble the ones before, so that either can be foreseen.
class RootSchedule {
 public:
  explicit RootSchedule(int num_ranks) : ranks_(static_cast<std::size_t>(num_ranks)) {}

  /// All ranks begin a step at `now_s`.
  void start_all(double now_s);
  /// The verdict of the step leaves, which root took `across_s` to find.
  void told(double now_s, double across_s);
  /// Root's own last step.
  void note_own(const StepPace& own) { own_ = own; }
  /// The poses of another rank came between `after_s` and `by_s`; `pace`: of its last step.
  void arrived(int rank, double after_s, double by_s, const StepPace& pace);

  /// When the last of the other ranks' poses should come.
  double expected_s() const;
  /// Does the step end sooner if root waits for them from `now_s` on?
  bool should_wait(double now_s) const;

 private:
  struct Rank {
    double began_s = 0;  ///< its step: where its poses were posted
    StepPace pace;
  };
  double expected_s(const Rank& rank) const;

  std::vector<Rank> ranks_;  ///< [num_ranks] root's is not used
  StepPace own_;
  double told_s_ = 0;
  double across_s_ = 0;
};

}  // namespace pbmpi::mpi
