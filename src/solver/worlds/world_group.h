/// Worlds that are stepped together, in one pack.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "core/clock.h"
#include "solver/pack/pack.h"
#include "solver/parts/parted_step.h"
#include "solver/worlds/sor_world.h"
#include "stepping/stepper.h"

namespace pbmpi::solver {

/// Groups have nothing in common, so that threads may step them at the same time.
class WorldGroup {
 public:
  /// Borrows worlds and settings. The worlds must have equal laws, and be at the same step unless rows keep
  /// their order.
  WorldGroup(std::vector<SorWorld*> worlds, const stepping::StepperSettings& settings);

  std::span<SorWorld* const> worlds() const { return worlds_; }
  Pack& pack() { return *pack_; }
  /// Can these worlds continue together?
  bool stands_at_one_step() const;

  /// Takes steps and measures the worlds.
  void advance(int num_steps, core::PhaseTimes& times);

  /// Seconds that the last advance() of this group took.
  double spent_s() const { return spent_s_; }
  /// Gives the worlds `share` of these seconds as their cost. A pack is timed as a whole; its worlds share
  /// the time by the work on their rows, which predicts it well.
  void share_cost(double share);

 private:
  void step(core::PhaseTimes& times);
  void collide();
  void part();
  void end_step(core::PhaseTimes& times);
  void observe(core::PhaseTimes& times);

  std::vector<SorWorld*> worlds_;
  const stepping::StepperSettings* settings_;
  std::unique_ptr<Pack> pack_;
  std::vector<std::vector<model::Contact>> contacts_;  ///< [worlds] of this step
  std::vector<char> may_be_fast_;                      ///< [worlds] see Pack::find_fast()
  std::vector<char> may_be_slow_;           ///< [worlds] see Pack::find_slow(); none without a tolerance
  std::vector<PartedWorld> parted_worlds_;  ///< [worlds] for the current step
  PartedStep parted_;
  double spent_s_ = 0;
};

}  // namespace pbmpi::solver
