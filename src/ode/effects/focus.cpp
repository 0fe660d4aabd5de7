#include "ode/effects/focus.h"

namespace pbmpi::ode {

bool Focus::is_cut() const {
  return !field_->inside().empty() && !field_->outside().empty() &&
         field_->outside_iterations() < field_->iterations();
}

void Focus::enable(std::span<const int> bodies) {
  for (const int body : bodies) dBodyEnable(bodies_[body]);
}

void Focus::disable(std::span<const int> bodies) {
  for (const int body : bodies) dBodyDisable(bodies_[body]);
}

}  // namespace pbmpi::ode
