/// What a run of pbmpi is to simulate: a scene from its start, or what a checkpoint holds.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "app/pbmpi/options/options.h"
#include "io/run/checkpoint_file.h"
#include "model/state.h"
#include "mpi/comm/communicator.h"
#include "scenes/scene.h"

namespace pbmpi::app {

struct Work {
  scenes::SceneSource source;
  std::unique_ptr<scenes::Scene> scene;
  RunSpec spec;                                     ///< as resolve() leaves it
  std::shared_ptr<const model::Model> first_world;  ///< built once: much of a run depends on world 0
  /// [num_worlds] on root: the states from which a resumed run goes on; else empty
  std::vector<model::State> states;
};

/// Collective. Throws core::InputError.
Work new_work(const mpi::Communicator& comm, const Options& options);

/// Collective. The run that options.resume saved: scene and physics are those of the checkpoint. `options`
/// become what the command line, `args`, and the checkpoint say together. Throws core::InputError.
Work resumed_work(const mpi::Communicator& comm, const std::vector<std::string>& args, Options& options);

/// World `world` as the run starts with it.
std::shared_ptr<const model::Model> build_world(const Work& work, int world);

/// What a checkpoint of this run says beside its states. `asked`: how the work was to be cut.
io::Checkpoint checkpoint_without_states(const Work& work, Decomposition asked);

}  // namespace pbmpi::app
