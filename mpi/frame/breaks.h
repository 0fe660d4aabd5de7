/// Finds the joints that broke, and tells every rank.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "mpi/comm/communicator.h"
#include "stepping/frame.h"

namespace pbmpi::mpi {

/// Collective: does any world have the effect "breakable_joints"? `worlds`: the worlds that this rank
/// reports.
bool any_breakage(const Communicator& comm, std::span<const stepping::LocalWorld> worlds);

/// Collective. The joints that broke in step `first_step` or later, the same on every rank: one event each,
/// ordered by step, world and joint. The events' texts number the worlds from `first_world`.
std::vector<stepping::RunEvent> find_breaks(const Communicator& comm,
                                            std::span<const stepping::LocalWorld> worlds, int first_world,
                                            std::int64_t frame, std::int64_t first_step);

}  // namespace pbmpi::mpi
