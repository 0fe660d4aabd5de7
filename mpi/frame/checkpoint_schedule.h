/// When a run is saved, and what is saved of it.
#pragma once

#include <atomic>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "model/state.h"

namespace pbmpi::mpi {

/// A run as it stands between two frames: all that is needed to resume it.
struct Snapshot {
  std::int64_t frames = 0;  ///< done, warm-up included
  std::int64_t steps = 0;   ///< done
  std::uint64_t state_hash = 0;
  bool ends_run = false;             ///< no frame follows
  std::vector<model::State> worlds;  ///< [num_worlds]
};

/// Stores snapshots.
class SnapshotKeeper {
 public:
  virtual ~SnapshotKeeper() = default;
  /// Called on root only. Returns one line on what was done; throws core::RunError if it failed.
  virtual std::string keep(Snapshot snapshot) = 0;
};

/// When to save. Equal on every rank, but for the clock and the requests.
struct CheckpointPlan {
  const std::atomic<int>* requests = nullptr;  ///< rises with each request from outside; borrowed
  double every_s = std::numeric_limits<double>::infinity();  ///< since the start or the last time
  bool at_stop = true;                                       ///< when a run ends early on request
  bool at_end = false;                                       ///< after the last frame
};

/// Decides after each frame, on root, if the run is saved. Sends nothing.
class CheckpointSchedule {
 public:
  enum class Then { next_frame, stop, end };  ///< what follows the frame

  CheckpointSchedule(const CheckpointPlan& plan, double start_s) : plan_(plan), last_s_(start_s) {}

  /// Is the run to be saved now? `requests`: the largest number of requests that any rank has seen so far (a
  /// signal that reaches all ranks is one request, though they see it in different frames).
  bool due(Then then, std::int64_t requests, double now_s);

 private:
  CheckpointPlan plan_;
  double last_s_;
  std::int64_t answered_ = 0;
};

}  // namespace pbmpi::mpi
