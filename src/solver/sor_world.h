/// One world of the sor stepper, apart from its lanes: events, collision detection and what is measured.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "model/contact.h"
#include "model/observables.h"
#include "model/state.h"
#include "solver/broad_phase.h"
#include "solver/pack.h"

namespace pbmpi::solver {

class SorWorld {
 public:
  SorWorld(int id, std::shared_ptr<const model::Model> model, const model::State& state, std::int64_t step,
           const model::MakeNarrowPhase& make_narrow_phase);

  int id() const { return id_; }
  std::int64_t step() const { return step_; }
  const model::Model& model() const { return *model_; }
  const model::State& state() const { return state_; }
  const model::Observables& observables() const { return observables_; }
  const std::vector<model::Contact>& contacts() const { return contacts_; }

  /// Puts the state and the joint settings of this step into a fresh pack.
  void enter(Pack& pack, int index) const;
  /// The events of this step.
  void fire_events(Pack& pack, int index) const;
  /// Contacts at the pack's poses.
  void collide(const Pack& pack, int index);
  void finish_step() { ++step_; }
  /// Reads the state back and measures it; rows and contacts are those of the last step.
  void observe(const Pack& pack, int index);

  double cost_s = 0;  ///< of the last advance()

 private:
  void apply_setting(const model::Event& event, Pack& pack, int index) const;
  void count_rows(const Pack& pack, int index);

  int id_;
  std::shared_ptr<const model::Model> model_;
  model::State state_;
  std::int64_t step_;
  BroadPhase broad_phase_;
  std::unique_ptr<model::NarrowPhase> narrow_phase_;
  std::vector<model::BodyPose> poses_;
  std::vector<model::GeomPair> pairs_;
  std::vector<model::Contact> contacts_;
  model::Observables observables_;
};

}  // namespace pbmpi::solver
