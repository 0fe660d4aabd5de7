/// Sends whole states of worlds between ranks.
#pragma once

#include <functional>
#include <map>
#include <span>
#include <vector>

#include "model/state.h"
#include "mpi/comm/communicator.h"

namespace pbmpi::mpi {

/// Blocking message between two ranks.
void send_state(const Communicator& comm, const model::State& state, int to);
model::State receive_state(const Communicator& comm, int from);

/// Collective. Sends root's `states` [num_worlds] to the ranks that own the worlds, `placement` [num_worlds];
/// returns this rank's states by world. Throws core::RunError on every rank unless root has one state per
/// world.
std::map<int, model::State> scatter_states(const Communicator& comm, std::span<const int> placement,
                                           std::span<const model::State> states);

/// Collective. The states of all worlds, [num_worlds], on root; none elsewhere. `state_of` is called for the
/// worlds of this rank.
std::vector<model::State> gather_states(const Communicator& comm, std::span<const int> placement,
                                        const std::function<const model::State&(int world)>& state_of);

/// Collective. Copies root's state to every rank; `state` is read on root only.
model::State share_state(const Communicator& comm, const model::State& state);

}  // namespace pbmpi::mpi
