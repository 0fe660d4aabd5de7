/// Reads a scene on root and gives it to all ranks.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "mpi/comm/communicator.h"
#include "scenes/scene.h"

namespace pbmpi::app {

/// Collective. Root reads the text and every rank has the same copy, so that a file that only some ranks can
/// read is no special case. Throws core::InputError on every rank.
scenes::SceneSource share_scene(const mpi::Communicator& comm, const std::string& name_or_path);

/// The name of a study's parameter that holds a scene's text: '/' would open a group.
std::string scene_text_parameter(std::string scene_name);

/// Collective. The scene of share_scene(), parsed.
std::unique_ptr<scenes::Scene> load_scene(const mpi::Communicator& comm, const std::string& name_or_path,
                                          std::optional<double> dt_s,
                                          std::optional<scenes::SpacesForm> spaces = std::nullopt,
                                          const model::EffectChoices& effects = {});

}  // namespace pbmpi::app
