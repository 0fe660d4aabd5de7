/// Collects what happens to each world while a run runs.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "io/setup/world_results.h"
#include "mpi/comm/communicator.h"
#include "mpi/frame/frame_driver.h"
#include "stepping/frame.h"

namespace pbmpi::app {

/// One per rank. A rank sums up what it sees of the worlds that it owns. These sums of whole numbers, largest
/// and last values are the same whichever ranks owned a world, and when; only cost and moves depend on that.
class WorldResults final : public stepping::FrameObserver {
 public:
  /// What this rank spent in the last frame on the worlds that it steps, including those that another rank
  /// reports.
  using Costs = std::function<std::vector<mpi::WorldCost>()>;

  WorldResults(int num_worlds, Costs costs) : num_worlds_(num_worlds), costs_of_frame_(std::move(costs)) {}

  void frame_done(const stepping::FrameRecord& frame) override;

  /// Collective. [num_worlds] on root, nothing elsewhere; `last`: this rank's worlds as they are now.
  std::vector<io::WorldResult> join(const mpi::Communicator& comm,
                                    const std::vector<stepping::LocalWorld>& last) const;

 private:
  static constexpr std::int64_t never = std::numeric_limits<std::int64_t>::max();

  /// What a rank has seen of a world; values not seen leave those of other ranks unchanged when joined.
  struct Seen {
    std::int64_t world = 0;
    std::int64_t seen_until = 0;  ///< frames done when this rank last had it
    std::int64_t contacts = 0, arrivals = 0;
    std::int64_t nonfinite_step = never;  ///< of the first frame with a non-finite value
    double energy_first_j = 0, joint_gap_max_m = 0, penetration_max_m = 0, row_visits = 0, cost_s = 0;
    // At the end, on the rank that then owns the world:
    std::int64_t frozen_in = -1;
    double energy_last_j = 0;
    std::uint64_t hash = 0;
  };

  void add(const stepping::LocalWorld& world, const stepping::FrameRecord& frame);
  static void join(const Seen& part, Seen& whole);
  io::WorldResult result_of(const Seen& seen) const;

  int num_worlds_;
  Costs costs_of_frame_;
  std::int64_t num_frames_ = 0;
  std::map<int, Seen> seen_;  ///< of the worlds that this rank has stepped
};

}  // namespace pbmpi::app
