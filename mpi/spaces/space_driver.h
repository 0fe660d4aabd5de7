/// Runs worlds that are cut into spaces over the ranks: one world over all ranks, or many worlds, each over a
/// group.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "mpi/frame/frame_driver.h"
#include "mpi/frame/pose_gather.h"
#include "mpi/spaces/cut_world.h"
#include "mpi/spaces/plan/rank_groups.h"
#include "stepping/space_stepper.h"

namespace pbmpi::mpi {

/// The frame loop of the spaces decomposition. Ranks form groups, each with a communicator of its own, and
/// step the worlds of their group one after the other (CutWorld). After each frame root of a group has the
/// whole states of its worlds and reports them; other ranks report no world. Root of all gets the poses from
/// the roots of groups through one PoseGather, and without any message where there is one group.
///
/// Between two frames spaces change their owner within their group if the last frames predict that its
/// busiest rank then has less to do (settings.rebalance_threshold). SpaceRebalancer decides when; SpaceLoads
/// describes the costs.
class SpaceDriver final : public FrameDriver {
 public:
  /// One world over all ranks. `stepper` is borrowed and holds the world; settings.num_worlds is 1, and
  /// settings.placement places its spaces. `states`: on root, the one state after settings.first_frame
  /// frames, if that is above 0.
  SpaceDriver(const Communicator& comm, stepping::SpaceStepper& stepper, const WorldRunSettings& settings,
              std::span<const model::State> states = {});

  /// Worlds in groups. `steppers`: the steppers of this rank's group, by ascending world, borrowed;
  /// settings.placement, if it is not empty, gives the spaces of each world ranks of its group. `states`: on
  /// root, [num_worlds]. `groups` is the same on every rank.
  SpaceDriver(const Communicator& comm, std::span<stepping::SpaceStepper* const> steppers,
              const RankGroups& groups, const WorldRunSettings& settings,
              std::span<const model::State> states = {});

  /// Guards the worlds: root of a group, which has their whole states after each frame, steps a world again
  /// by itself where a guard suspects a defect, and shares the result. `settings` is borrowed. Called on
  /// every rank or on none, before run().
  void watch(const stability::GuardSettings& settings);

  /// Estimates every frame first (FEEC), with steppers of the same worlds. Borrowed. Called on every rank or
  /// on none, before run().
  void estimate_with(std::span<stepping::SpaceStepper* const> steppers);

  const stepping::WorldTable& table() const override { return table_; }
  std::vector<stepping::LocalWorld> local_worlds() const override;
  std::vector<WorldCost> costs() const override;
  std::vector<int> idle_ranks() const override;
  /// [num_spaces] present owner of each space of this rank's first world, as a rank of its group
  const std::vector<int>& placement() const { return worlds_.front()->ownership().owner; }

  /// Has the hook called after each step of this rank's first world. For tests.
  void set_step_hook(CutWorld::StepHook hook) { worlds_.front()->set_step_hook(std::move(hook)); }

 private:
  std::span<const stepping::LocalWorld> compute_estimate(std::int64_t frame,
                                                         core::PhaseTimes& times) override;
  void advance(core::PhaseTimes& times) override;
  int lowest_nonfinite_world() const override;
  std::int64_t count_nonfinite(int world) const override { return at(world).observables().nonfinite; }
  std::vector<stepping::RunEvent> take_events() override;
  void settle_events() override;
  int reporter_of(int world) const override { return roots_[world]; }
  void gather(core::PhaseTimes& times) override;
  std::span<const core::Vec3> position() const override { return gather_->position(); }
  std::span<const core::Quat> orientation() const override { return gather_->orientation(); }
  std::int64_t plan_moves(bool last) override;
  std::string make_moves(std::int64_t num_moves, std::int64_t step) override;
  std::uint64_t state_hash() const override;
  std::vector<model::State> gather_states() const override;
  core::Traffic take_traffic() override;

  void build(std::span<stepping::SpaceStepper* const> steppers);
  std::map<int, model::State> starts(std::span<const model::State> states) const;
  void count_bodies();
  const CutWorld& at(int world) const { return *worlds_[world - ids_.front()]; }

  RankGroups groups_;
  Placement roots_;                                ///< [num_worlds] rank that reports each
  Communicator group_;                             ///< the ranks of this rank's group
  Communicator estimating_;                        ///< the same ranks as group_, with FEEC
  std::vector<int> ids_;                           ///< worlds of this rank's group, ascending
  std::vector<std::unique_ptr<CutWorld>> worlds_;  ///< [ids_]
  stepping::WorldTable table_;
  std::unique_ptr<PoseGather> gather_;
  std::vector<stepping::LocalWorld> estimated_worlds_;  ///< with FEEC, on the root of a group
};

}  // namespace pbmpi::mpi
