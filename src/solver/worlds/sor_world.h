/// One world of the sor stepper, apart from its lanes: events and what is measured.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "effects/breakage.h"
#include "effects/fast_bodies.h"
#include "effects/field_of_interest.h"
#include "effects/sleepers.h"
#include "model/contact.h"
#include "model/state.h"
#include "solver/layout/passes.h"
#include "solver/pack/focused_step.h"
#include "solver/pack/pack.h"
#include "stepping/observables.h"
#include "stepping/stepper.h"

namespace pbmpi::solver {

class SorWorld {
 public:
  SorWorld(int id, std::shared_ptr<const model::Model> model, const model::State& state, std::int64_t step,
           const stepping::StepperSettings& settings, const model::MakeNarrowPhase& make_narrow_phase);

  int id() const { return id_; }
  std::int64_t step() const { return step_; }
  const model::Model& model() const { return *model_; }
  const Passes& passes() const { return passes_; }
  const model::State& state() const { return state_; }
  const stepping::Observables& observables() const { return observables_; }

  /// Forgets where the world was; a pack that holds it must be loaded anew.
  void set_state(const model::State& state, std::int64_t step);

  /// Would a joint that is broken now hold again in this state? A pack has no way back.
  bool mends(const model::State& state) const;
  /// Puts the state into the pack.
  void load(Pack& pack, int index) const;
  /// The same, with the joint settings of this step, into a fresh pack.
  void enter(Pack& pack, int index) const;
  /// The events of this step.
  void fire_events(Pack& pack, int index);
  /// Adds the contacts of fast bodies to those of this step; nothing without the pass.
  void look_ahead(const Pack& pack, int index, double dt_s, std::vector<model::Contact>& contacts);
  /// Finds out which islands matter; nothing without the pass "field_of_interest".
  void focus(const Pack& pack, int index, std::span<const model::Contact> contacts);
  /// Null without that pass.
  const effects::FieldOfInterest* field() const { return field_ ? &*field_ : nullptr; }
  /// Lets the steps to come move all that is awake.
  void activate(Pack& pack, int index) const { pack.set_active(index, awake()); }
  /// False if all bodies sleep: a step changes nothing.
  bool moves() const { return !sleepers_ || !sleepers_->awake().empty(); }
  /// Wakes what these contacts touch; true if it lay asleep, so that its own contacts are still to be found.
  bool wake_touched(Pack& pack, int index, std::span<const model::Contact> contacts);
  /// Before finish_step(): breaks what the step's load was too much for.
  void strain(Pack& pack, int index, const FocusedStep& step);
  /// After a step with these contacts: lets islands fall asleep.
  void settle(Pack& pack, int index, std::span<const model::Contact> contacts);
  /// Puts what sleeps into `state` as it is.
  void keep_sleepers(model::State& state) const;
  /// For the pairs of shapes that the lanes do not collide.
  model::NarrowPhase& narrow_phase() const { return *narrow_phase_; }
  void finish_step() {
    moved_ = moved_ || moves();
    ++step_;
  }
  /// Reads the state back and measures it; rows and contacts are those of the last step.
  void observe(const Pack& pack, int index, const FocusedStep& step,
               std::span<const model::Contact> contacts);

  /// Of the last step; the state must have come from it.
  void observe_residuals(const Pack& pack, int index, const FocusedStep& step) {
    observables_.residuals = step.residuals(pack, index);
  }
  /// Bodies that the last step moved.
  int num_awake() const { return static_cast<int>(awake().size()); }

  double cost_s = 0;  ///< of the last advance()

 private:
  void let_go();
  std::span<const int> awake() const { return sleepers_ ? sleepers_->awake() : all_bodies_; }
  void show_awake(Pack& pack, int index) const;
  void count_rows(const Pack& pack, int index, const FocusedStep& step,
                  std::span<const model::Contact> contacts);

  int id_;
  std::shared_ptr<const model::Model> model_;
  Passes passes_;  ///< of this world alone
  model::State state_;
  std::int64_t step_;
  std::vector<int> all_bodies_;
  std::unique_ptr<model::NarrowPhase> narrow_phase_;
  std::optional<effects::FastBodies> fast_bodies_;  ///< none without the pass
  std::optional<effects::FieldOfInterest> field_;   ///< likewise
  model::State before_step_;                        ///< with either: at the start of the step
  stepping::Observables observables_;
  std::optional<effects::Sleepers> sleepers_;  ///< none without the effect "sleeping"
  std::optional<effects::Breakage> breakage_;  ///< none without the effect "breakable_joints"
  bool moved_ = true;                          ///< since the last observe()
};

}  // namespace pbmpi::solver
