#include "mpi/frame/state_transfer.h"

#include <cstdint>
#include <string>

#include "core/error.h"
#include "mpi/comm/agreement.h"
#include "mpi/frame/whole_state.h"

namespace pbmpi::mpi {
namespace {

constexpr int state_tag = 1;

}  // namespace

/// The length of a state may change from step to step, because the contact forces that it holds come and go.
void send_state(const Communicator& comm, const model::State& state, int to) {
  const std::vector<double> packed = pack(state);
  const std::int64_t size = std::ssize(packed);
  comm.send(std::span<const std::int64_t>(&size, 1), to, state_tag);
  comm.send(std::span<const double>(packed), to, state_tag);
}

model::State receive_state(const Communicator& comm, int from) {
  std::int64_t size = 0;
  comm.recv(std::span(&size, 1), from, state_tag);
  std::vector<double> packed(static_cast<std::size_t>(size));
  comm.recv(std::span(packed), from, state_tag);
  return unpack(packed);
}

std::map<int, model::State> scatter_states(const Communicator& comm, std::span<const int> placement,
                                           std::span<const model::State> states) {
  agree_on_errors(comm, [&] {
    if (comm.is_root() && states.size() != placement.size())
      throw core::RunError("there are " + std::to_string(states.size()) + " states to start from, and " +
                           std::to_string(placement.size()) + " worlds; resume with as many worlds");
  });
  std::map<int, model::State> own;
  for (int world = 0; world < std::ssize(placement); ++world) {
    const int owner = placement[world];
    if (comm.is_root() && owner == Communicator::root) own[world] = states[world];
    if (owner == Communicator::root) continue;
    if (comm.is_root()) {
      send_state(comm, states[world], owner);
    } else if (owner == comm.rank()) {
      own[world] = receive_state(comm, Communicator::root);
    }
  }
  return own;
}

std::vector<model::State> gather_states(const Communicator& comm, std::span<const int> placement,
                                        const std::function<const model::State&(int world)>& state_of) {
  std::vector<model::State> states;
  for (int world = 0; world < std::ssize(placement); ++world) {
    const int owner = placement[world];
    if (owner == comm.rank() && !comm.is_root()) {
      send_state(comm, state_of(world), Communicator::root);
    } else if (comm.is_root() && owner == Communicator::root) {
      states.push_back(state_of(world));
    } else if (comm.is_root()) {
      states.push_back(receive_state(comm, owner));
    }
  }
  return states;
}

model::State share_state(const Communicator& comm, const model::State& state) {
  std::vector<double> numbers;
  if (comm.is_root()) numbers = pack(state);
  std::int64_t size = std::ssize(numbers);
  comm.bcast_value(size);
  numbers.resize(static_cast<std::size_t>(size));
  comm.bcast(std::span(numbers));
  return unpack(numbers);
}

}  // namespace pbmpi::mpi
