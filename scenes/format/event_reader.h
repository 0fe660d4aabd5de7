/// Events that a scene file lists one by one.
#pragma once

#include <functional>

#include "scenes/format/table_reader.h"
#include "scenes/parts/growing_model.h"

namespace pbmpi::scenes {

/// Adds an event to a model that has all its bodies and joints. Throws core::InputError if the event names
/// one that does not exist.
using EventPlan = std::function<void(GrowingModel&)>;

/// Reads an [[event]] table (scenes/FORMAT.md); its time becomes the nearest step of `dt_s`.
EventPlan read_event(TableReader& table, double dt_s);

}  // namespace pbmpi::scenes
