/// How jobs of known length, such as the islands of a step, would run on several cores.
#pragma once

#include <span>

namespace pbmpi::analysis {

/// Length of the schedule [same unit as `lengths`] when the jobs, longest first, each go to the core that is
/// free first (Graham, "Bounds on multiprocessing timing anomalies", 1969). `cores` >= 1.
double longest_first_makespan(std::span<const double> lengths, int cores);

/// The fewest cores on which the schedule is no longer than (1 + tolerance) times the longest job; 0 without
/// jobs that take time.
int fewest_cores(std::span<const double> lengths, double tolerance);

/// One frame of a run whose islands, and then also spaces, have a core each. The step that was profiled
/// stands for all of its frame.
struct ParallelFrame {
  double serial_s = 0;       ///< as measured
  double collide_s = 0;      ///< of that, collision detection
  double islands_share = 1;  ///< longest island / all islands, of the profiled step
  double spaces_share = 1;   ///< collision detection with a core a space / in one piece, of that step
  double solve_s = 0;        ///< of serial_s, the solver: what islands divide

  /// Only the solver is divided.
  double islands_parallel_s() const { return serial_s - solve_s + solve_s * islands_share; }
  /// Solver and collision detection are.
  double spaces_parallel_s() const { return islands_parallel_s() - collide_s + collide_s * spaces_share; }
};

}  // namespace pbmpi::analysis
