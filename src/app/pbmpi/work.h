/// The work of a run of pbmpi: a scene from its start, or what a checkpoint holds.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/pbmpi/options/options.h"
#include "io/run/checkpoint_file.h"
#include "model/state.h"
#include "mpi/comm/communicator.h"
#include "scenes/parameter_table.h"
#include "scenes/scene.h"

namespace pbmpi::app {

struct Work {
  scenes::SceneSource source;
  std::unique_ptr<scenes::Scene> scene;
  std::optional<scenes::ParameterTable> parameters;  ///< for the whole ensemble
  RunSpec spec;                                      ///< from resolve()
  std::shared_ptr<const model::Model> first_world;   ///< built once: much of a run depends on its first world
  /// [num_worlds] on root: the states from which a resumed run goes on; empty elsewhere
  std::vector<model::State> states;
};

/// Collective. Throws core::InputError.
Work new_work(const mpi::Communicator& comm, const Options& options);

/// Collective. The run that options.resume saved, with the checkpoint's scene and physics. `options` is
/// replaced by the options of the command line, `args`, and the checkpoint together. Throws core::InputError.
Work resumed_work(const mpi::Communicator& comm, const std::vector<std::string>& args, Options& options);

/// World `world` of the run as it starts; its number in the ensemble is spec.first_world() + world.
std::shared_ptr<const model::Model> build_world(const Work& work, int world);

/// build_world(), but built anew for each call.
std::shared_ptr<const model::Model> build_anew(const Work& work, int world);

/// The content of a checkpoint of this run, without states. `asked`: how the work was to be cut.
io::Checkpoint checkpoint_without_states(const Work& work, Decomposition asked);

}  // namespace pbmpi::app
