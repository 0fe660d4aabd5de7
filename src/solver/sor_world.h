/// One world of the sor stepper, apart from its lanes: events and what is measured.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "model/contact.h"
#include "model/fast_bodies.h"
#include "model/observables.h"
#include "model/sleepers.h"
#include "model/state.h"
#include "solver/pack.h"

namespace pbmpi::solver {

class SorWorld {
 public:
  /// Steps take `dt_s`.
  SorWorld(int id, std::shared_ptr<const model::Model> model, const model::State& state, std::int64_t step,
           double dt_s, const model::MakeNarrowPhase& make_narrow_phase);

  int id() const { return id_; }
  std::int64_t step() const { return step_; }
  const model::Model& model() const { return *model_; }
  const model::State& state() const { return state_; }
  const model::Observables& observables() const { return observables_; }

  /// Forgets where the world was; a pack that holds it must be loaded anew.
  void set_state(const model::State& state, std::int64_t step);

  /// Puts the state into the pack.
  void load(Pack& pack, int index) const;
  /// The same, with the joint settings of this step, into a fresh pack.
  void enter(Pack& pack, int index) const;
  /// The events of this step.
  void fire_events(Pack& pack, int index);
  /// Adds the contacts of fast bodies to those of this step; nothing without the pass.
  void look_ahead(const Pack& pack, int index, double dt_s, std::vector<model::Contact>& contacts);
  /// False if all bodies sleep: a step changes nothing.
  bool moves() const { return !sleepers_ || !sleepers_->awake().empty(); }
  /// Wakes what these contacts touch; true if it lay asleep, so that its own contacts are still to be found.
  bool wake_touched(Pack& pack, int index, std::span<const model::Contact> contacts);
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
  void observe(const Pack& pack, int index, std::span<const model::Contact> contacts);

  /// Of the last step; the state must have come from it.
  void observe_residuals(const Pack& pack, int index) { observables_.residuals = pack.residuals(index); }
  /// Bodies that the last step moved.
  int num_awake() const {
    return sleepers_ ? static_cast<int>(sleepers_->awake().size()) : model_->num_bodies();
  }

  double cost_s = 0;  ///< of the last advance()

 private:
  void show_awake(Pack& pack, int index) const;
  void observe_sleep();
  void count_rows(const Pack& pack, int index, std::span<const model::Contact> contacts);

  int id_;
  std::shared_ptr<const model::Model> model_;
  model::State state_;
  std::int64_t step_;
  std::unique_ptr<model::NarrowPhase> narrow_phase_;
  std::optional<model::FastBodies> fast_bodies_;  ///< none without the pass
  model::State before_step_;                      ///< with it: at the start of the step
  model::Observables observables_;
  std::optional<model::Sleepers> sleepers_;  ///< none without the effect "sleeping"
  bool moved_ = true;                        ///< since the last observe()
};

}  // namespace pbmpi::solver
