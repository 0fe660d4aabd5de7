/// Helpers of the tests of scenes.
#pragma once

#include <memory>
#include <string>

#include "model/model.h"
#include "scenes/scene.h"

namespace pbmpi::scenes {

using core::Pose;
using core::Vec3;

/// Parses `text` under the file name "test.toml".
std::unique_ptr<Scene> parse(const std::string& text);

/// The model of world 0, seed 1.
std::shared_ptr<const model::Model> build(const std::string& text);

/// The message of the core::InputError with which parsing `text` fails, or "" if it does not fail.
std::string error_of(const std::string& text);

/// `error_of` a scene that consists of a title, a ground and these lines, which start at line 5.
std::string error_after_ground(const std::string& lines);

/// The body of that name; fails the test if there is none.
const model::Body& body(const model::Model& model, const std::string& name);
const model::Joint& joint(const model::Model& model, const std::string& name);

/// Every bit of what moves and collides, so that two models can be compared.
std::uint64_t fingerprint(const model::Model& model);

/// A scene with one actor of this type on a ground.
std::string scene_with(const std::string& type, const std::string& more_keys = "");

}  // namespace pbmpi::scenes
