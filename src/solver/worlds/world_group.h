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
  /// Borrows worlds and settings. The worlds have equal laws; they stand at one step unless rows keep their
  /// order.
  WorldGroup(std::vector<SorWorld*> worlds, const stepping::StepperSettings& settings);

  std::span<SorWorld* const> worlds() const { return worlds_; }
  Pack& pack() { return *pack_; }
  /// May these worlds go on together?
  bool stands_at_one_step() const;

  /// Takes steps, of which the first may have begun, and measures the worlds.
  void advance(int num_steps, core::PhaseTimes& times);
  /// See AnytimeStepper.
  void begin_step(int iterations, core::PhaseTimes& times);
  bool has_begun() const { return has_begun_; }
  const model::State& look(int index) const { return looks_[static_cast<std::size_t>(index)]; }

  /// Seconds that the last advance() or begin_step() took by itself.
  double spent_s() const { return spent_s_; }
  /// Of each second spent since the last share_cost() the worlds cost `share`: keeps that for the step that
  /// has begun.
  void note_cost(double share) { cost_s_ += share * spent_s_; }
  /// A pack is timed as a whole; its worlds share the time by the work on their rows, which predicts it well.
  void share_cost();

 private:
  /// Up to the iterations of the last substep; `look_after`: they will be looked at after so many.
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
  std::vector<char> may_be_fast_;                      ///< likewise: Pack::find_fast()
  std::vector<char> may_be_slow_;           ///< likewise: Pack::find_slow(); none without a tolerance
  std::vector<PartedWorld> parted_worlds_;  ///< [worlds] for the step at hand
  PartedStep parted_;
  bool sleeps_ = false;              ///< in the step at hand nothing moves
  bool has_begun_ = false;           ///< is the group in mid-step?
  std::vector<model::State> looks_;  ///< [worlds] of the step that was begun
  double spent_s_ = 0, cost_s_ = 0;
};

}  // namespace pbmpi::solver
