/// Settings of a run: how many frames, how long a step, when work moves.
#pragma once

#include <cstdint>
#include <vector>

#include "mpi/comm/communicator.h"
#include "stepping/frame.h"

namespace pbmpi::mpi {

/// Settings of a run of worlds, whole or cut into spaces. The same on every rank.
struct WorldRunSettings {
  int num_worlds = 1;
  int first_world = 0;  ///< number of world 0 in its ensemble, from which its random numbers come
  int warmup = 3;       ///< frames before the measured ones
  int frames = 5;       ///< measured frames
  int steps_per_frame = 3;
  double dt_s = 0.01;
  double budget_s = stepping::default_frame_budget_s;  ///< deadline of a frame
  double rebalance_threshold = 1.1;  ///< work moves when max/avg useful time exceeds this; infinity = never
  bool stop_at_blowup = false;       ///< a guard that trips ends the run after the frame
  bool profile = false;  ///< measure the last step of each frame again, after the frame's time is taken
  std::int64_t first_frame = 0;  ///< frames done before: above 0 the run is resumed from a checkpoint
  /// [worlds or spaces] rank that owns each at the start; empty = as the driver chooses
  std::vector<int> placement;

  std::int64_t first_step() const { return first_frame * steps_per_frame; }
};

/// Collective. Returns the settings once every rank has found them valid. `num_parts`: worlds, or spaces of a
/// world, that a placement places. Throws core::InputError for settings that make no sense, and
/// std::logic_error if they differ between ranks.
WorldRunSettings checked_settings(const Communicator& comm, WorldRunSettings settings, int num_parts);

}  // namespace pbmpi::mpi
