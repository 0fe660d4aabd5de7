/// When a run is saved, and what is saved of it.
#pragma once

#include <atomic>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "model/state.h"

namespace pbmpi::mpi {

/// A run as it stands between two frames: everything that is needed to resume it.
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
  /// Called on root only. Returns one line that says what was stored; throws core::RunError if storing
  /// failed.
  virtual std::string keep(Snapshot snapshot) = 0;
};

/// When to save. Equal on every rank, except the clock and the requests.
struct CheckpointPlan {
  const std::atomic<int>* requests = nullptr;  ///< rises with each request from outside; borrowed
  double every_s = std::numeric_limits<double>::infinity();  ///< seconds since the start or the last save
  bool at_stop = true;                                       ///< save when a run ends early on request
  bool at_end = false;                                       ///< save after the last frame
};

/// Decides on root after each frame whether the run is saved. Sends nothing.
class CheckpointSchedule {
 public:
  enum class Then { next_frame, stop, end };  ///< what follows the frame

  CheckpointSchedule(const CheckpointPlan& plan, double start_s) : plan_(plan), last_s_(start_s) {}

  /// Should the run be saved now? `requests`: the largest number of requests that any rank has seen so far (a
  /// signal that reaches all ranks is one request, though they see it in different frames).
  bool due(Then then, std::int64_t requests, double now_s);

 private:
  CheckpointPlan plan_;
  double last_s_;
  std::int64_t answered_ = 0;
};

}  // namespace pbmpi::mpi
