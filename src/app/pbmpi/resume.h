/// How a run goes on from a checkpoint.
#pragma once

#include <iosfwd>
#include <optional>
#include <string>

#include "io/run/checkpoint_file.h"
#include "mpi/comm/communicator.h"
#include "scenes/scene.h"

namespace pbmpi::app {

/// Collective. The checkpoint in `path`; the states of its worlds on root only. Throws core::InputError: not
/// a checkpoint, damaged, of another version of pbmpi. Of another build of this version `warnings` is told.
io::Checkpoint load_checkpoint(const mpi::Communicator& comm, const std::string& path,
                               std::ostream& warnings);

/// Collective. The text of the checkpoint's scene. `asked`: the scene that was named beside it, or nothing;
/// throws core::InputError if it is another one.
scenes::SceneSource scene_of(const mpi::Communicator& comm, const io::Checkpoint& checkpoint,
                             const std::string& path, const std::string& asked);

}  // namespace pbmpi::app
