/// Joints that a scene file lists one by one.
#pragma once

#include <functional>

#include "scenes/format/table_reader.h"
#include "scenes/parts/growing_model.h"

namespace pbmpi::scenes {

/// Adds a joint to a model that has all its bodies. Throws core::InputError if the joint names a body that
/// does not exist.
using JointPlan = std::function<void(GrowingModel&)>;

/// Reads a [[joint]] table (scenes/FORMAT.md) and refuses keys that its kind does not have.
JointPlan read_joint(TableReader& table);

}  // namespace pbmpi::scenes
