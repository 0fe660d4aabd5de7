/// Collects a run's summary while it runs.
#pragma once

#include "app/summary/run_summary.h"
#include "mpi/comm/communicator.h"
#include "mpi/worlds/world_driver.h"
#include "stepping/frame.h"

namespace pbmpi::app {

/// One per rank: sums over the rank's own worlds, joined over the ranks at the end.
class LiveSummary final : public stepping::FrameObserver {
 public:
  void frame_done(const stepping::FrameRecord& frame) override;
  void event(const stepping::RunEvent& event) override {
    joints_broken_ += event.kind == stepping::joint_broken ? 1 : 0;
  }

  /// Collective. Fills what is measured into `summary`, whose settings (worlds, bodies, ranks,
  /// steps_per_frame, budget_s) are set.
  void finish(const mpi::Communicator& comm, const mpi::WorldRunResult& result, RunSummary& summary) const;

 private:
  std::vector<double> islands_, contacts_, rows_;  ///< [measured frames] sums over this rank's worlds
  std::vector<double> max_island_rows_;            ///< [measured frames]
  double max_joint_gap_m_ = 0, max_penetration_m_ = 0;
  double energy_j_ = 0;   ///< at the last frame
  double nonfinite_ = 0;  ///< at the last frame
  std::int64_t joints_broken_ = 0;
};

}  // namespace pbmpi::app
