/// One world of the sor stepper, apart from its lanes: its rules and what is measured.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "effects/step_rules.h"
#include "model/contact.h"
#include "model/state.h"
#include "solver/contacts/contact_recall.h"
#include "solver/layout/pack_laws.h"
#include "solver/pack/pack.h"
#include "solver/parts/island_rows.h"
#include "solver/parts/parted_step.h"
#include "stepping/motor_targets.h"
#include "stepping/observables.h"
#include "stepping/stepper.h"

namespace pbmpi::solver {

/// Most calls name the pack that holds the world, and its index there.
class SorWorld {
 public:
  SorWorld(int id, std::shared_ptr<const model::Model> model, const model::State& state, std::int64_t step,
           const stepping::StepperSettings& settings, const model::MakeNarrowPhase& make_narrow_phase);

  int id() const { return id_; }
  std::int64_t step() const { return step_; }
  const model::Model& model() const { return *model_; }
  const PackLaws& laws() const { return laws_; }
  const model::State& state() const { return state_; }
  const stepping::Observables& observables() const { return observables_; }
  /// Null unless the run asks for contacts.
  const stepping::StepContacts* contacts() const { return shows_contacts_ ? &shown_ : nullptr; }

  /// Replaces the state; a pack that holds the world must be loaded anew, or entered anew if the step has
  /// changed.
  void set_state(const model::State& state, std::int64_t step);
  /// WorldStepper::set_motor_velocity(). `pack`: null if none holds the world.
  void aim(int joint, int axis, double velocity, Pack* pack, int index);
  /// WorldStepper::set_load(), likewise.
  void push(int body, const stepping::BodyLoad& load, Pack* pack, int index);

  /// Is a joint that is broken now unbroken in `state`? A pack cannot mend joints.
  bool mends(const model::State& state) const;
  /// Puts the state into the pack.
  void load(Pack& pack, int index) const;
  /// Puts the state, with the joint settings of this step, the targets of motors and loads, into the pack.
  void enter(Pack& pack, int index) const;

  // A step, in the order of effects::StepRules.
  void begin_step(Pack& pack, int index);
  /// Adds speculative contacts to the contacts of this step, if it may have fast bodies. True if bodies woke
  /// whose own contacts are still to be found.
  [[nodiscard]] bool after_collision(Pack& pack, int index, bool may_be_fast,
                                     std::vector<model::Contact>& contacts);
  /// may_be_slow: see Pack::find_slow().
  void before_solve(Pack& pack, int index, bool may_be_slow, std::vector<model::Contact>& contacts);
  /// The world as it enters the solve.
  PartedWorld parted(std::span<const model::Contact> contacts);
  /// Replaces the contacts by those with which the step ended, if it has changed them.
  void after_solve(Pack& pack, int index, std::vector<model::Contact>& contacts, PartedStep& step);
  /// Replaces all calls after begin_step() if no world of the pack moves.
  void sleep_on();

  /// Makes the awake bodies active for the coming steps.
  void activate(Pack& pack, int index) const { pack.set_active(index, rules_.awake()); }
  /// False if all bodies sleep: a step changes nothing.
  bool moves() const { return !rules_.all_asleep(); }
  /// Collides the pairs of shapes that the lanes do not handle.
  model::NarrowPhase& narrow_phase() const { return *narrow_phase_; }
  /// Reads the state back and measures it; rows and contacts are those of the last step.
  void observe(const Pack& pack, int index, const PartedStep& step, std::span<const model::Contact> contacts);

  /// Measures the residuals of the last step, which must have produced the current state.
  void observe_residuals(const Pack& pack, int index, const PartedStep& step) {
    observables_.residuals = step.residuals(pack, index);
  }
  /// May some islands get more or fewer substeps than others?
  bool moves_in_parts() const { return shares_.has_value(); }
  /// Bodies that the last step moved.
  int num_awake() const { return static_cast<int>(rules_.awake().size()); }

  double cost_s = 0;  ///< of the last advance()

 private:
  class InPack;
  void forget(int body) { model::forget(*model_, body, state_.memory); }
  void show_awake(Pack& pack, int index) const;
  /// Wakes the islands of these bodies.
  void wake(std::span<const int> bodies, Pack* pack, int index);
  void recall(const Pack& pack, int index, std::span<const model::Contact> contacts);
  void sort_islands(const Pack& pack, int index, std::span<const model::Contact> contacts);
  void show_contacts(const Pack& pack, int index, std::span<const model::Contact> contacts);
  void count_rows(const Pack& pack, int index, const PartedStep& step,
                  std::span<const model::Contact> contacts);

  int id_;
  std::shared_ptr<const model::Model> model_;
  PackLaws laws_;
  model::State state_;
  std::int64_t step_;
  stepping::MotorTargets targets_;
  std::map<int, stepping::BodyLoad> loads_;  ///< by body; others have none
  effects::StepRules rules_;
  std::unique_ptr<model::NarrowPhase> narrow_phase_;
  bool remembers_;       ///< forces, from step to step
  bool shows_contacts_;  ///< StepperSettings::contacts
  ContactRecall recall_;
  std::optional<IslandShares> shares_;  ///< none where all islands get the same
  bool sorted_ = false;                 ///< are the islands sorted for the current step?
  model::State before_, after_;         ///< with shares: see PartedWorld
  stepping::StateObserver observer_;
  stepping::Observables observables_;
  stepping::StepContacts shown_;  ///< contacts of the last step, if they are shown
  bool moved_ = true;             ///< has the world moved since the last observe()?
  /// [num_joints] The two bodies of each joint, contiguous for count_rows().
  std::vector<std::pair<int, int>> jointed_;
  IslandRows island_rows_;  ///< scratch of count_rows()
};

}  // namespace pbmpi::solver
