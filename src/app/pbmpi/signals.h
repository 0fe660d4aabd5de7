/// Stops a run at the end of its frame on SIGINT, SIGTERM or SIGUSR2.
///
/// USR2 is what a job script sends to mpirun: Open MPI 4.1 forwards it to every rank and passes on their exit
/// code 75, while after a TERM or INT of its own it kills the ranks and ends with 1.
#pragma once

#include <atomic>

namespace pbmpi::app {

/// While one of these lives, these signals set its flag instead of ending the process. One at a time.
class StopOnSignal {
 public:
  StopOnSignal();
  ~StopOnSignal();
  StopOnSignal(const StopOnSignal&) = delete;
  StopOnSignal& operator=(const StopOnSignal&) = delete;

  /// 0, or the number of the signal that came.
  const std::atomic<int>& flag() const;
};

}  // namespace pbmpi::app
