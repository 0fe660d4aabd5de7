/// Events that a scene file gives one by one.
#pragma once

#include <functional>

#include "model/model.h"
#include "scenes/format/table_reader.h"

namespace pbmpi::scenes {

/// Adds an event to a model whose bodies and joints are all there. Throws core::InputError if it names one
/// that is not.
using EventPlan = std::function<void(model::Model&)>;

/// Reads an [[event]] table (scenes/FORMAT.md); its time becomes the nearest step of `dt_s`.
EventPlan read_event(TableReader& table, double dt_s);

}  // namespace pbmpi::scenes
