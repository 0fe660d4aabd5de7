/// Joints that a scene file gives one by one.
#pragma once

#include <functional>

#include "model/model.h"
#include "scenes/format/table_reader.h"

namespace pbmpi::scenes {

/// Adds a joint to a model whose bodies are all placed. Throws core::InputError if it names a body that is
/// not there.
using JointPlan = std::function<void(model::Model&)>;

/// Reads a [[joint]] table (scenes/FORMAT.md) and refuses what its kind does not have.
JointPlan read_joint(TableReader& table);

}  // namespace pbmpi::scenes
