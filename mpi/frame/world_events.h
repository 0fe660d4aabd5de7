/// Tells every rank the events that only the owners of worlds know.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mpi/comm/communicator.h"
#include "stepping/frame.h"
#include "stepping/run_event.h"

namespace pbmpi::mpi {

/// Collective. The events of all ranks in `frame`, the same on every rank: ordered by step and world, and
/// within one world and step as they happened.
std::vector<stepping::RunEvent> share_events(const Communicator& comm,
                                             std::span<const stepping::RunEvent> own, std::int64_t frame);

/// Collective: does any world have the effect "breakable_joints"? `worlds`: the worlds that this rank
/// reports.
bool any_breakage(const Communicator& comm, std::span<const stepping::LocalWorld> worlds);

/// Collective. The joints that broke in step `first_step` or later, the same on every rank: one event each,
/// ordered by step, world and joint. The events' texts number the worlds from `first_world`.
std::vector<stepping::RunEvent> find_breaks(const Communicator& comm,
                                            std::span<const stepping::LocalWorld> worlds, int first_world,
                                            std::int64_t frame, std::int64_t first_step);

}  // namespace pbmpi::mpi
