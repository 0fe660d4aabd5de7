/// The effect "field_of_interest" in one ODE world that is stepped with dWorldQuickStep.
#pragma once

#include <span>
#include <vector>

#include "effects/field_of_interest.h"
#include "model/state.h"
#include "ode/collide/contacts.h"
#include "ode/objects/handles.h"

namespace pbmpi::ode {

/// ODE's number of iterations is one of a call, and a call steps what is enabled. Islands are disabled as a
/// whole, so that ODE wakes none of them.
class Focus {
 public:
  /// `iterations`: of the run.
  Focus(const model::Model& model, const std::vector<dBodyID>& bodies, int iterations);

  /// Joints are broken from now on: as in model::State.
  void set_broken(const model::Model& model, std::span<const std::int32_t> broken_in) {
    field_.set_broken(model, broken_in);
  }

  /// Sorts these bodies, which are enabled, by the state at the start of the step and its contacts.
  void look(std::span<const int> bodies, const model::State& state, const std::vector<Touch>& touches);
  std::span<const int> all_bodies() const { return all_bodies_; }

  /// Are there islands of both sorts, to be stepped one after the other?
  bool is_cut() const;
  const effects::FieldOfInterest& field() const { return field_; }
  /// Of all islands, if the step is not cut.
  int iterations() const {
    return field_.inside().empty() ? field_.outside_iterations() : field_.iterations();
  }

  void enable_outside() { disable(field_.inside()); }
  void enable_inside() {
    enable(field_.inside());
    disable(field_.outside());
  }
  void enable_both() { enable(field_.outside()); }

 private:
  void enable(std::span<const int> bodies);
  void disable(std::span<const int> bodies);

  effects::FieldOfInterest field_;
  std::vector<dBodyID> bodies_;
  std::vector<int> all_bodies_;
  std::vector<effects::BodyPair> touching_;
};

}  // namespace pbmpi::ode
