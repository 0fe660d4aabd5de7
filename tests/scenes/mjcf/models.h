/// Helpers of the tests of other simulators' models.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "model/model.h"

namespace pbmpi::scenes {

/// Builds scene "m" from this text as file "m.xml": world 0, seed 1.
std::shared_ptr<const model::Model> model_of(const std::string& xml);

/// The notes about this text.
std::vector<std::string> notes_of(const std::string& xml);

/// The message of the core::InputError that this text throws, or "".
std::string refusal_of(const std::string& xml);

/// A <mujoco> with `world` in its <worldbody>, and `before` in front of that; angles in radians.
std::string mujoco(const std::string& world, const std::string& before = "");

/// A body at the origin with a box of 1 kg and `more` in it.
std::string boxed(const std::string& more, const std::string& attributes = "");

/// The body "m.NAME"; fails the test if there is none.
const model::Body& link(const model::Model& model, const std::string& name);
const model::Joint& joint_of(const model::Model& model, const std::string& name);

/// Does any note contain these words?
bool says(const std::vector<std::string>& notes, const std::string& words);

}  // namespace pbmpi::scenes
