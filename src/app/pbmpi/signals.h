/// What signals ask of a run: SIGINT, SIGTERM or SIGUSR2 stop it at the end of its frame, SIGUSR1 saves it.
///
/// USR2 is what a job script sends to mpirun: Open MPI 4.1 forwards it to every rank and passes on their exit
/// code 75, while after a TERM or INT of its own it kills the ranks and ends with 1. It forwards USR1, too.
#pragma once

#include <atomic>

#include "stepping/frame.h"

namespace pbmpi::app {

/// While one of these lives, signals are heard like this. One at a time.
/// - USR1 and USR2 are noted.
/// - INT and TERM end the process at once while the run is being set up: there is nothing to save. Later the
///   first one is noted, and the second one ends the process at once. What comes within 0.1 s of the first
///   counts as one with it: mpirun may pass on what the whole process group got.
/// - If the frame in which INT or TERM came does not end within ten seconds, or three times the longest frame
///   so far, the process ends all the same.
/// In a process that ends at once, core::Leftover's files go; the run's file holds the frames committed
/// before.
class SignalRequests {
 public:
  SignalRequests();
  ~SignalRequests();
  SignalRequests(const SignalRequests&) = delete;
  SignalRequests& operator=(const SignalRequests&) = delete;

  /// What the run is about.
  enum class Phase { set_up, begin_or_end, frames };
  /// `speaks`: this rank says on stderr that it has heard.
  void enter(Phase phase, bool speaks) const;

  /// 0, or the number of the signal that wants the run to stop.
  const std::atomic<int>& stop() const;
  /// How often the run was to be saved.
  const std::atomic<int>& saves() const;
};

/// Tells SignalRequests how long frames take. On every rank.
class FrameWatch final : public stepping::FrameObserver {
 public:
  FrameWatch();
  void frame_done(const stepping::FrameRecord& frame) override;
  void secure() override;  ///< saving the run takes the time that it takes

 private:
  double last_s_;
};

}  // namespace pbmpi::app
