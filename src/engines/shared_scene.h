/// Reads a scene or a table of parameters on root and gives it to all ranks.
#pragma once

#include <string>

#include "mpi/comm/communicator.h"
#include "scenes/parameter_table.h"
#include "scenes/scene.h"

namespace pbmpi::engines {

/// Collective. Root reads the text and every rank gets the same copy, so that a file that only some ranks can
/// read needs no special handling. Throws core::InputError on every rank.
scenes::SceneSource share_scene(const mpi::Communicator& comm, const std::string& name_or_path);

/// Collective. Root reads the table of the worlds' parameters and gives it to all ranks.
scenes::ParameterTable share_parameters(const mpi::Communicator& comm, const std::string& path);

}  // namespace pbmpi::engines
