#include "ode/effects/focus.h"

#include <numeric>

namespace pbmpi::ode {

Focus::Focus(const model::Model& model, const std::vector<dBodyID>& bodies, int iterations)
    : field_(model, iterations), bodies_(bodies), all_bodies_(bodies.size()) {
  std::iota(all_bodies_.begin(), all_bodies_.end(), 0);
}

void Focus::look(std::span<const int> bodies, const model::State& state, const std::vector<Touch>& touches) {
  touching_.clear();
  for (const Touch& touch : touches) touching_.emplace_back(touch.body_a, touch.body_b);
  field_.look(state.position);
  field_.sort(bodies, state.position, touching_);
}

bool Focus::is_cut() const {
  return !field_.inside().empty() && !field_.outside().empty() &&
         field_.outside_iterations() < field_.iterations();
}

void Focus::enable(std::span<const int> bodies) {
  for (const int body : bodies) dBodyEnable(bodies_[body]);
}

void Focus::disable(std::span<const int> bodies) {
  for (const int body : bodies) dBodyDisable(bodies_[body]);
}

}  // namespace pbmpi::ode
