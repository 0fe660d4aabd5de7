/// Whole states of worlds that travel between ranks.
#pragma once

#include <functional>
#include <map>
#include <span>
#include <vector>

#include "model/state.h"
#include "mpi/comm/communicator.h"

namespace pbmpi::mpi {

/// Blocking, between two ranks.
void send_state(const Communicator& comm, const model::State& state, int to);
model::State receive_state(const Communicator& comm, int from);

/// Collective. Sends root's `states` [num_worlds] to the ranks at which their worlds are, `placement`
/// [num_worlds]; returns those of this rank by world. Throws core::RunError on every rank if root has not as
/// many states as there are worlds.
std::map<int, model::State> scatter_states(const Communicator& comm, std::span<const int> placement,
                                           std::span<const model::State> states);

/// Collective. On root the states of all worlds, [num_worlds]; none elsewhere. `state_of` is asked for the
/// worlds that are at this rank.
std::vector<model::State> gather_states(const Communicator& comm, std::span<const int> placement,
                                        const std::function<const model::State&(int world)>& state_of);

/// Collective. Root's numbers, however many, on every rank; `numbers` are read there only.
std::vector<double> share_numbers(const Communicator& comm, std::vector<double> numbers);
/// Collective. Root's state, on every rank; `state` is read there only.
model::State share_state(const Communicator& comm, const model::State& state);

}  // namespace pbmpi::mpi
