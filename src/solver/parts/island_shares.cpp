#include "solver/parts/island_shares.h"

#include <algorithm>

#include "solver/pack/step_settings.h"

namespace pbmpi::solver {

IslandShares::IslandShares(const model::Model& model, const stepping::StepperSettings& settings)
    : islands_(model), loaded_marks_(model), is_loaded_(model.bodies.size(), 0) {
  if (spares_substeps(settings)) quiet_.emplace(model, settings);
  if (adds_substeps(settings)) loaded_.emplace(model, settings);
}

/// Islands are found only where a body may be in one that differs.
void IslandShares::sort(std::span<const int> bodies, std::span<const model::Contact> contacts,
                        std::span<const model::ContactForce> forces, std::span<const std::int32_t> broken_in,
                        const model::State& before) {
  const bool any_slow =
      quiet_ && std::ranges::any_of(bodies, [&](int body) { return quiet_->is_slow(body, before); });
  overloaded_.clear();
  if (loaded_) loaded_->find(bodies, contacts, forces, broken_in, before, overloaded_);
  any_loaded_ = !overloaded_.empty();
  if (any_slow || any_loaded_) islands_.connect(contacts, broken_in);
  if (any_loaded_) mark_loaded(bodies);
  if (any_slow) {
    quiet_->foresee(bodies, islands_, before);
  } else if (quiet_) {
    quiet_->foresee_none();
  }
}

void IslandShares::mark_loaded(std::span<const int> bodies) {
  loaded_marks_.clear(bodies);
  for (const int body : overloaded_) loaded_marks_.mark(body, islands_);
  for (const int body : bodies)
    is_loaded_[static_cast<std::size_t>(body)] = static_cast<char>(loaded_marks_.has(body, islands_));
}

}  // namespace pbmpi::solver
