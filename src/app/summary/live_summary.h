/// Collects a run's summary while it runs.
#pragma once

#include <cstdint>
#include <vector>

#include "app/summary/run_summary.h"
#include "mpi/comm/communicator.h"
#include "mpi/worlds/world_driver.h"
#include "stepping/frame.h"

namespace pbmpi::app {

/// One per rank: joins the rank's own worlds frame by frame, and the ranks at the end.
class LiveSummary final : public stepping::FrameObserver {
 public:
  void frame_done(const stepping::FrameRecord& frame) override;
  void event(const stepping::RunEvent& event) override {
    joints_broken_ += event.kind == stepping::event_kind::joint_broken ? 1 : 0;
    guards_.add(event);
  }

  /// Collective. Fills the measured values into `summary`, whose settings (worlds, bodies, ranks,
  /// steps_per_frame, budget_s) are set; energy and phases on root only.
  void finish(const mpi::Communicator& comm, const mpi::WorldRunResult& result, RunSummary& summary) const;

 private:
  struct WorldEnergy {
    std::int64_t world;
    double energy_j;
  };
  /// Collective. Energy of all worlds, added in their order: counts add up to the same number in any order,
  /// whereas this sum would depend on which rank has which world. 0 except on root.
  double total_energy(const mpi::Communicator& comm) const;

  ObservedFrames observed_;            ///< of this rank's worlds
  std::vector<WorldEnergy> energies_;  ///< of this rank's worlds after the last frame
  std::int64_t joints_broken_ = 0;
  GuardSummary guards_;
};

}  // namespace pbmpi::app
