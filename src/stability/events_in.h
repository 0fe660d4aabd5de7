/// Selects the events of some steps.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>

#include "model/model.h"

namespace pbmpi::stability {

/// The model's events at the start of each of the `num_steps` steps from `first_step` on.
inline std::span<const model::Event> events_in(const model::Model& model, std::int64_t first_step,
                                               std::int64_t num_steps) {
  const auto begin = std::ranges::lower_bound(model.events, first_step, {}, &model::Event::step);
  const auto end = std::ranges::lower_bound(model.events, first_step + num_steps, {}, &model::Event::step);
  return {begin, end};
}

}  // namespace pbmpi::stability
