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

/// One frame of a run as if each island, and then also each space, had a core. The profiled step stands for
/// all steps of the frame.
struct ParallelFrame {
  double serial_s = 0;       ///< as measured
  double collide_s = 0;      ///< part of it for collision detection
  double islands_share = 1;  ///< longest island / all islands, of the profiled step
  double spaces_share = 1;   ///< collision detection with one core per space / in one piece, in that step
  double solve_s = 0;        ///< part of serial_s for the solver, which islands divide

  /// Divides only the solver.
  double islands_parallel_s() const { return serial_s - solve_s + solve_s * islands_share; }
  /// Divides solver and collision detection.
  double spaces_parallel_s() const { return islands_parallel_s() - collide_s + collide_s * spaces_share; }
};

}  // namespace pbmpi::analysis
