#include "solver/parts/island_shares.h"

#include <algorithm>
#include <utility>

#include "solver/pack/step_settings.h"

namespace pbmpi::solver {

IslandShares::IslandShares(const model::Model& model, const stepping::StepperSettings& settings)
    : substeps_(settings.substeps), islands_(model) {
  if (spares_substeps(settings)) quiet_.emplace(model, settings);
  tall_.emplace(model, settings);
  if (!tall_->can_be()) tall_.reset();
  if (FineIslands::can_be(settings)) fine_.emplace(model, settings);
}

std::optional<IslandShares> IslandShares::find(const model::Model& model,
                                               const stepping::StepperSettings& settings) {
  IslandShares shares(model, settings);
  return shares.quiet_ || shares.tall_ || shares.fine_ ? std::optional(std::move(shares)) : std::nullopt;
}

/// Finds islands only where some body may be in one with a different share.
void IslandShares::sort(std::span<const int> bodies, std::span<const model::Contact> contacts,
                        std::span<const std::int32_t> broken_in, const model::State& before) {
  any_fine_ = fine_ && fine_->find(bodies, contacts, broken_in, islands_);
  any_tall_ = tall_ && tall_->find(bodies, contacts, broken_in, islands_);
  if (!quiet_) return;
  if (std::ranges::any_of(bodies, [&](int body) { return quiet_->is_slow(body, before); })) {
    islands_.connect(contacts, broken_in);
    quiet_->foresee(bodies, islands_, before);
  } else {
    quiet_->foresee_none();
  }
}

}  // namespace pbmpi::solver
