/// The events of a step.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>

#include "model/model.h"

namespace pbmpi::model {

/// In the model's order.
inline std::span<const Event> events_of(const Model& model, std::int64_t step) {
  // Not equal_range(), whose result clang 14 cannot compile with g++ 12's library.
  const auto first = std::ranges::lower_bound(model.events, step, {}, &Event::step);
  const auto end = std::ranges::upper_bound(model.events, step, {}, &Event::step);
  return {first, end};
}

}  // namespace pbmpi::model
