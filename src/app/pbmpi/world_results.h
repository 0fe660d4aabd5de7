/// Collects what becomes of each world while a run runs.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "io/setup/world_results.h"
#include "mpi/comm/communicator.h"
#include "mpi/frame/frame_driver.h"
#include "stepping/frame.h"

namespace pbmpi::app {

/// One per rank. A rank sums up what it sees of the worlds that it owns; as sums of whole numbers, largest
/// and last values they are the same whoever has owned a world, and when. Only cost and moves tell of it.
class WorldResults final : public stepping::FrameObserver {
 public:
  /// What this rank spent in the last frame on the worlds that it steps, also those that another reports.
  using Costs = std::function<std::vector<mpi::WorldCost>()>;

  WorldResults(int num_worlds, Costs costs);

  void frame_done(const stepping::FrameRecord& frame) override;

  /// Collective. [num_worlds] the same on every rank; `last`: this rank's worlds as they are now.
  std::vector<io::WorldResult> join(const mpi::Communicator& comm,
                                    const std::vector<stepping::LocalWorld>& last) const;

 private:
  void add(const stepping::LocalWorld& world, const stepping::FrameRecord& frame);

  using Counts = std::vector<std::int64_t>;
  using Numbers = std::vector<double>;

  Costs costs_of_frame_;
  std::int64_t num_frames_ = 0;
  // [num_worlds] of what this rank has seen; 0 of what it has not
  Counts contacts_, arrivals_;
  Counts seen_until_;      ///< frames done when this rank last had the world
  Counts nonfinite_step_;  ///< of the first such frame
  Numbers energy_first_j_, joint_gap_max_m_, penetration_max_m_, row_visits_, cost_s_;
};

}  // namespace pbmpi::app
