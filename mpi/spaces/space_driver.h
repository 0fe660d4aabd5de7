/// Runs one world over the ranks: each rank owns collision spaces and the bodies in them.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "mpi/frame/frame_driver.h"
#include "mpi/spaces/plan/space_loads.h"
#include "mpi/spaces/space_estimate.h"
#include "mpi/spaces/space_rebalancer.h"
#include "mpi/spaces/step/space_step.h"
#include "stability/world_guard.h"
#include "stepping/space_stepper.h"

namespace pbmpi::mpi {

/// The frame loop of the spaces decomposition (step/space_step.h says what a step is). Root has the whole
/// state after each frame and reports it; other ranks report no world. The result is that of the undecomposed
/// world, bit for bit.
///
/// Between two frames spaces change their owner if the last frames predict that the busiest rank then has
/// less to do: settings.rebalance_threshold; SpaceRebalancer decides when, SpaceLoads says what is weighed.
class SpaceDriver final : public FrameDriver {
 public:
  /// `stepper` is borrowed and holds the world; settings.num_worlds is 1, and settings.placement of its
  /// spaces. `states`: on root, the one state after settings.first_frame frames, if that is above 0.
  SpaceDriver(const Communicator& comm, stepping::SpaceStepper& stepper, const WorldRunSettings& settings,
              std::span<const model::State> states = {});

  /// Watches the world: root, which has its whole state after each frame, steps it again by itself where a
  /// guard suspects something, and shares what has become of it. `settings` is borrowed. On every rank or on
  /// none, before run().
  void watch(const stability::GuardSettings& settings);

  /// Estimates every frame first (FEEC), with a stepper of the same world; by `due_s` after the start of the
  /// frame, if it is due. Borrowed. On every rank or on none, before run().
  void estimate_with(stepping::SpaceStepper& stepper, std::optional<double> due_s);

  const stepping::WorldTable& table() const override { return table_; }
  std::vector<stepping::LocalWorld> local_worlds() const override;
  std::vector<int> idle_ranks() const override;
  /// [num_spaces] owner of each space now
  const std::vector<int>& placement() const { return ownership_.owner; }

  /// Called after each step, on every rank, with the contacts that this rank solved. For tests.
  using StepHook = std::function<void(std::int64_t step, std::span<const model::Contact> contacts)>;
  void set_step_hook(StepHook hook) { hook_ = std::move(hook); }

 private:
  double make_estimate(std::int64_t frame, double frame_start_s, core::PhaseTimes& times) override;
  const stepping::EstimateRecord* estimate(double delivered_s) override;
  void advance(core::PhaseTimes& times) override;
  int lowest_nonfinite_world() const override;
  std::int64_t count_nonfinite(int world) const override;
  std::vector<stepping::RunEvent> take_events() override {
    for (stepping::RunEvent& event : events_) event.world = 0;
    return std::exchange(events_, {});
  }
  void settle_events() override;
  int reporter_of(int world) const override;
  void gather(core::PhaseTimes& times) override;
  std::span<const core::Vec3> position() const override { return stepper_->state().position; }
  std::span<const core::Quat> orientation() const override { return stepper_->state().orientation; }
  std::int64_t plan_moves(bool last) override;
  std::string make_moves(std::int64_t num_moves, std::int64_t step) override;
  std::uint64_t state_hash() const override;
  std::vector<model::State> gather_states() const override;
  core::Traffic take_traffic() override;

  void estimate_frame(core::PhaseTimes& times);
  void step_frame(core::PhaseTimes& times);
  void observe();
  void end_watched_frame();
  const model::State& whole_state() const;
  void broadcast_state();

  stepping::SpaceStepper* stepper_;
  SpaceOwnership ownership_;
  SpaceStep step_;
  stepping::WorldTable table_;
  stepping::Observables observables_;           ///< on root
  std::optional<stability::WorldGuard> guard_;  ///< on root
  stability::Watched now_, before_;             ///< on root, with a guard: after this frame and the last
  std::vector<stepping::RunEvent> events_;      ///< on root
  bool is_mended_ = false;                      ///< on root: now_ has replaced what the ranks have computed
  bool is_frozen_ = false;                      ///< the world stands
  std::int64_t steps_done_ = 0;
  SpaceRebalancer rebalancer_;  ///< used on root
  Reassignment planned_;        ///< root: what rebalancer_ decided after the last frame
  StepHook hook_;
  std::unique_ptr<SpaceEstimate> estimate_;  ///< with FEEC
  bool is_advanced_ = false;                 ///< the frame is done: its estimate was the precise result
  std::vector<stepping::LocalWorld> estimated_worlds_;  ///< on root
  stepping::EstimateRecord estimate_record_;
};

/// Owners of spaces before anything is measured: longest processing time first, by the rows of their joints
/// and their bodies.
std::vector<int> initial_owners(const model::SpaceMap& map, int num_ranks);

}  // namespace pbmpi::mpi
