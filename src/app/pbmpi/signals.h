/// Stops a run at the end of its frame on SIGINT or SIGTERM.
#pragma once

#include <atomic>

namespace pbmpi::app {

/// While one of these lives, SIGINT and SIGTERM set its flag instead of ending the process. One at a time.
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
