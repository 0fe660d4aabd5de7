/// One world of the sor stepper, apart from its lanes: events and what is measured.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "model/contact.h"
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
  /// False if all bodies sleep: a step changes nothing.
  bool moves() const { return !sleepers_ || !sleepers_->awake().empty(); }
  /// Wakes what these contacts touch; true if it lay asleep, so that its own contacts are still to be found.
  bool wake_touched(Pack& pack, int index, std::span<const model::Contact> contacts);
  /// After a step with these contacts: lets islands fall asleep.
  void settle(Pack& pack, int index, std::span<const model::Contact> contacts);
  /// For the pairs of shapes that the lanes do not collide.
  model::NarrowPhase& narrow_phase() const { return *narrow_phase_; }
  void finish_step() {
    moved_ = moved_ || moves();
    ++step_;
  }
  /// Reads the state back and measures it; rows and contacts are those of the last step.
  void observe(const Pack& pack, int index, std::span<const model::Contact> contacts);

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
  model::Observables observables_;
  std::optional<model::Sleepers> sleepers_;  ///< none without the effect "sleeping"
  bool moved_ = true;                        ///< since the last observe()
};

}  // namespace pbmpi::solver
