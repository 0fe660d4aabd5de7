#include "solver/parts/island_shares.h"

#include <algorithm>
#include <utility>

#include "solver/pack/step_settings.h"

namespace pbmpi::solver {

IslandShares::IslandShares(const model::Model& model, const stepping::StepperSettings& settings)
    : substeps_(settings.substeps),
      most_substeps_(settings.most_substeps),
      islands_(model),
      loaded_marks_(model),
      is_loaded_(model.bodies.size(), 0) {
  if (spares_substeps(settings)) quiet_.emplace(model, settings);
  if (adds_substeps(settings) && settings.sag_m > 0) loaded_.emplace(model, settings);
  tall_.emplace(model, settings);
  if (!tall_->can_be()) tall_.reset();
}

std::optional<IslandShares> IslandShares::find(const model::Model& model,
                                               const stepping::StepperSettings& settings) {
  IslandShares shares(model, settings);
  const bool any = shares.quiet_ || shares.loaded_ || shares.tall_;
  return any ? std::optional(std::move(shares)) : std::nullopt;
}

/// Finds islands only where some body may be in one with a different share.
void IslandShares::sort(std::span<const int> bodies, std::span<const model::Contact> contacts,
                        std::span<const model::ContactForce> forces, std::span<const std::int32_t> broken_in,
                        const model::State& before) {
  const bool any_slow =
      quiet_ && std::ranges::any_of(bodies, [&](int body) { return quiet_->is_slow(body, before); });
  overloaded_.clear();
  if (loaded_) loaded_->find(bodies, contacts, forces, broken_in, before, overloaded_);
  any_loaded_ = !overloaded_.empty();
  any_tall_ = tall_ && tall_->find(bodies, contacts, broken_in, islands_);
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
