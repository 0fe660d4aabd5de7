/// Worlds that are stepped together, in one pack.
#pragma once

#include <memory>
#include <optional>
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

  /// Takes steps, of which the first may have begun, and measures the worlds.
  void advance(int num_steps, core::PhaseTimes& times);
  /// See AnytimeStepper.
  void begin_step(int iterations, core::PhaseTimes& times);
  bool has_begun() const { return has_begun_; }
  const model::State& look(int index) const { return looks_[static_cast<std::size_t>(index)]; }

  /// Seconds that the last advance() or begin_step() of this group took.
  double spent_s() const { return spent_s_; }
  /// Adds `share` of the seconds of the last advance() or begin_step() to the worlds' cost, until
  /// share_cost().
  void note_cost(double share) { cost_s_ += share * spent_s_; }
  /// A pack is timed as a whole; its worlds share the time by the work on their rows, which predicts it well.
  void share_cost();

 private:
  /// Takes the step up to the iterations of the last substep; `look_after`: after how many of these a look
  /// follows.
  void begin(std::optional<int> look_after, core::PhaseTimes& times);
  void collide();
  void part();
  void finish(core::PhaseTimes& times);
  void take_looks(core::PhaseTimes& times);
  void observe(core::PhaseTimes& times);

  std::vector<SorWorld*> worlds_;
  const stepping::StepperSettings* settings_;
  std::unique_ptr<Pack> pack_;
  std::vector<std::vector<model::Contact>> contacts_;  ///< [worlds] of this step
  std::vector<char> may_be_fast_;                      ///< [worlds] see Pack::find_fast()
  std::vector<char> may_be_slow_;           ///< [worlds] see Pack::find_slow(); none without a tolerance
  std::vector<PartedWorld> parted_worlds_;  ///< [worlds] for the current step
  PartedStep parted_;
  bool sleeps_ = false;              ///< does nothing move in the current step?
  bool has_begun_ = false;           ///< is the group in mid-step?
  std::vector<model::State> looks_;  ///< [worlds] of the step that was begun
  double spent_s_ = 0, cost_s_ = 0;
};

}  // namespace pbmpi::solver
