/// Runs many worlds over the ranks: each rank owns whole worlds and steps them without a message inside a
/// step.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "mpi/balance/rebalance.h"
#include "mpi/frame/frame_driver.h"
#include "mpi/frame/pose_gather.h"
#include "mpi/worlds/owned_worlds.h"
#include "stepping/estimator.h"
#include "stepping/stepper.h"

namespace pbmpi::mpi {

/// The frame loop of the worlds decomposition. The stepper is borrowed and holds this rank's worlds, also
/// after the run. advance sends no message; poses and costs are gathered over a tree of ranks, which is flat
/// for up to 32 ranks (mpi/comm/tree_gather.h).
///
/// With an estimator (FEEC) a frame begins with: estimate -> send the estimated poses to root, without
/// waiting -> root waits for them and hands them on, while the other ranks advance. The precise states are
/// the same bits with and without it.
class WorldDriver final : public FrameDriver {
 public:
  /// Throws core::InputError for settings that make no sense, and what BuildWorld or the stepper throws.
  /// `states`: on root, the states after settings.first_frame frames, if that is above 0.
  WorldDriver(const Communicator& comm, stepping::WorldStepper& stepper, BuildWorld build,
              const WorldRunSettings& settings, std::span<const model::State> states = {});

  /// Estimates every frame first. Borrowed; it must outlive run(). On every rank or on none.
  void set_estimator(stepping::Estimator& estimator);
  /// Announces the events of the stepper's worlds. Borrowed. Called on every rank or on none.
  void set_event_source(stepping::RunEventSource& source) { events_ = &source; }

  const stepping::WorldTable& table() const override { return worlds_.table(); }
  std::vector<stepping::LocalWorld> local_worlds() const override { return worlds_.views(); }
  std::vector<WorldCost> costs() const override;
  std::vector<int> idle_ranks() const override;
  /// [num_worlds] owner of each world now
  const std::vector<int>& placement() const { return worlds_.placement(); }

 private:
  std::span<const stepping::LocalWorld> compute_estimate(std::int64_t frame,
                                                         core::PhaseTimes& times) override;
  std::vector<stepping::LocalWorld> profiled_worlds() override;
  void advance(core::PhaseTimes& times) override;
  int lowest_nonfinite_world() const override;
  std::int64_t count_nonfinite(int world) const override {
    return stepper_->observables(worlds_.number_of(world)).nonfinite;
  }
  std::vector<stepping::RunEvent> take_events() override;
  int reporter_of(int world) const override { return worlds_.placement()[world]; }
  void gather(core::PhaseTimes& times) override;
  std::span<const core::Vec3> position() const override { return gather_.position(); }
  std::span<const core::Quat> orientation() const override { return gather_.orientation(); }
  std::int64_t plan_moves(bool last) override;
  std::string make_moves(std::int64_t num_moves, std::int64_t step) override;
  std::uint64_t state_hash() const override;
  core::Traffic take_traffic() override { return gather_.take_traffic(); }
  std::vector<model::State> gather_states() const override { return worlds_.gather_states(); }

  stepping::WorldStepper* stepper_;
  OwnedWorlds worlds_;
  PoseGather gather_;
  Rebalancer rebalancer_;  ///< used on root
  Rebalancing planned_;    ///< root: the moves of the last verdict
  stepping::Estimator* estimator_ = nullptr;
  stepping::RunEventSource* events_ = nullptr;
  std::vector<stepping::LocalWorld> estimated_worlds_;  ///< of this frame
};

}  // namespace pbmpi::mpi
