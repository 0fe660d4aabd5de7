/// What the tests of models from elsewhere share.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "model/model.h"

namespace pbmpi::scenes {

/// The scene "m" of this text, of the file "m.xml": world 0, seed 1.
std::shared_ptr<const model::Model> model_of(const std::string& xml);

/// What is said of it.
std::vector<std::string> notes_of(const std::string& xml);

/// The message of the core::InputError that it throws, or "".
std::string refusal_of(const std::string& xml);

/// A <mujoco> with this in its <worldbody>, and more before that; angles in radians.
std::string mujoco(const std::string& world, const std::string& before = "");

/// A body at the origin with a box of 1 kg and this in it.
std::string boxed(const std::string& more, const std::string& attributes = "");

/// The body "m.NAME"; fails the test if there is none.
const model::Body& link(const model::Model& model, const std::string& name);
const model::Joint& joint_of(const model::Model& model, const std::string& name);

/// Does any note say this?
bool says(const std::vector<std::string>& notes, const std::string& words);

}  // namespace pbmpi::scenes
