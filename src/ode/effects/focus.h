/// The effect "field_of_interest" in one ODE world that is stepped with dWorldQuickStep.
#pragma once

#include <span>
#include <vector>

#include "effects/field_of_interest.h"
#include "ode/objects/handles.h"

namespace pbmpi::ode {

/// ODE takes one number of iterations per call, and a call steps all enabled bodies. Islands are disabled as
/// a whole, so ODE wakes none of them.
class Focus {
 public:
  /// `field` is borrowed; it has sorted the enabled bodies before a step is taken.
  Focus(const effects::FieldOfInterest& field, const std::vector<dBodyID>& bodies)
      : field_(&field), bodies_(bodies) {}

  /// Are there islands both inside and outside, which are stepped one after the other?
  bool is_cut() const;
  int outside_iterations() const { return field_->outside_iterations(); }
  int inside_iterations() const { return field_->iterations(); }
  /// Iterations for all islands, if the step is not cut.
  int iterations() const { return field_->inside().empty() ? outside_iterations() : inside_iterations(); }
  int iterations_of(int body) const { return field_->iterations_of(body); }

  void enable_outside() { disable(field_->inside()); }
  void enable_inside() {
    enable(field_->inside());
    disable(field_->outside());
  }
  void enable_both() { enable(field_->outside()); }

 private:
  void enable(std::span<const int> bodies);
  void disable(std::span<const int> bodies);

  const effects::FieldOfInterest* field_;
  std::vector<dBodyID> bodies_;
};

}  // namespace pbmpi::ode
