/// Tells every rank the events that only the owners of worlds know.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mpi/comm/communicator.h"
#include "stepping/run_event.h"

namespace pbmpi::mpi {

/// Collective. The events of all ranks in `frame`, the same on every rank: ordered by step and world, and
/// within one world and step as they happened.
std::vector<stepping::RunEvent> share_events(const Communicator& comm,
                                             std::span<const stepping::RunEvent> own, std::int64_t frame);

}  // namespace pbmpi::mpi
