/// What signals ask of a run: SIGINT, SIGTERM or SIGUSR2 stop it at the end of its frame, SIGUSR1 saves it.
///
/// USR2 is what a job script sends to mpirun: Open MPI 4.1 forwards it to every rank and passes on their exit
/// code 75, while after a TERM or INT of its own it kills the ranks and ends with 1. It forwards USR1, too.
#pragma once

#include <atomic>

#include "stepping/frame.h"

namespace pbmpi::app {

/// While an object of this class lives, signals act as follows. At most one object at a time.
/// - USR1 and USR2 are noted.
/// - INT and TERM end the process at once while the run is being set up: there is nothing to save. Later the
///   first one is noted, and the second one ends the process at once. A signal within 0.1 s of the first
///   counts as the same one: mpirun may pass on a signal that the whole process group got.
/// - If the frame in which INT or TERM came does not end within ten seconds, or three times the longest frame
///   so far, the process ends all the same.
/// When a process ends at once, core::Leftover's files are removed; the run's file holds the frames committed
/// before.
class SignalRequests {
 public:
  SignalRequests();
  ~SignalRequests();
  SignalRequests(const SignalRequests&) = delete;
  SignalRequests& operator=(const SignalRequests&) = delete;

  /// What the run is doing.
  enum class Phase { set_up, begin_or_end, frames };
  /// `speaks`: this rank confirms on stderr the signals that it gets.
  void enter(Phase phase, bool speaks) const;

  /// 0, or the number of the signal that wants the run to stop.
  const std::atomic<int>& stop() const;
  /// How many times a save of the run was requested.
  const std::atomic<int>& saves() const;
};

/// Tells SignalRequests how long frames take. On every rank.
class FrameWatch final : public stepping::FrameObserver {
 public:
  FrameWatch();
  void frame_done(const stepping::FrameRecord& frame) override;
  void secure() override;  ///< saving may take as long as it needs

 private:
  double last_s_;
};

}  // namespace pbmpi::app
