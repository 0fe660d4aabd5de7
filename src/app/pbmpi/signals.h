/// What signals ask of a run: SIGINT, SIGTERM or SIGUSR2 stop it at the end of its frame, SIGUSR1 saves it.
///
/// USR2 is what a job script sends to mpirun: Open MPI 4.1 forwards it to every rank and passes on their exit
/// code 75, while after a TERM or INT of its own it kills the ranks and ends with 1. It forwards USR1, too.
#pragma once

#include <atomic>

namespace pbmpi::app {

/// While one of these lives, these signals are noted instead of ending the process. One at a time.
class SignalRequests {
 public:
  SignalRequests();
  ~SignalRequests();
  SignalRequests(const SignalRequests&) = delete;
  SignalRequests& operator=(const SignalRequests&) = delete;

  /// 0, or the number of the signal that wants the run to stop.
  const std::atomic<int>& stop() const;
  /// How often the run was to be saved.
  const std::atomic<int>& saves() const;
};

}  // namespace pbmpi::app
