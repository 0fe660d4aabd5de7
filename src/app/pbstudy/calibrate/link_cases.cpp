#include <vector>

#include "app/pbstudy/calibrate/calibrate_cases.h"
#include "core/clock.h"

namespace pbmpi::app {
namespace {

constexpr int burst = 64, burst_tag = 5, message_tag = 6;

/// Half of a message there and back; mean of several, since one is shorter than the clock resolves.
double time_there_and_back(const mpi::Communicator& comm, std::int64_t bytes) {
  const int rounds = bytes > 65536 ? 20 : 100;
  std::vector<std::byte> message(static_cast<std::size_t>(bytes));
  const double start_s = core::now_s();
  for (int round = 0; round < rounds; ++round) {
    if (comm.is_root()) {
      comm.send(std::span<const std::byte>(message), 1, message_tag);
      comm.recv(std::span(message), 1, message_tag);
    } else {
      comm.recv(std::span(message), 0, message_tag);
      comm.send(std::span<const std::byte>(message), 0, message_tag);
    }
  }
  return (core::now_s() - start_s) / (2.0 * rounds);
}

/// Time of one message in a burst at root, which either sends them all or receives what has already arrived.
double time_burst(const mpi::Communicator& comm, std::int64_t bytes, bool root_sends) {
  std::vector<std::byte> message(static_cast<std::size_t>(bytes));
  const bool sends = comm.is_root() == root_sends;
  const int other = comm.is_root() ? 1 : 0;
  const auto exchange = [&] {
    const double start_s = core::now_s();
    for (int i = 0; i < burst; ++i) {
      if (sends) {
        comm.send(std::span<const std::byte>(message), other, burst_tag);
      } else {
        comm.recv(std::span(message), other, burst_tag);
      }
    }
    return (core::now_s() - start_s) / burst;
  };
  exchange();  // opens the connection
  double seconds = 0;
  if (!comm.is_root()) {
    exchange();
    comm.send(std::span<const std::byte>(message), other, message_tag);
  } else if (root_sends) {
    seconds = exchange();
    comm.recv(std::span(message), other, message_tag);
  } else {
    comm.recv(std::span(message), other, message_tag);  // was sent after the burst
    seconds = exchange();
  }
  return seconds;
}

}  // namespace

double time_message(const mpi::Communicator& comm, const TimedCase& one) {
  if (one.part == TimedPart::message) return time_there_and_back(comm, one.bytes);
  return time_burst(comm, one.bytes, one.part == TimedPart::send);
}

}  // namespace pbmpi::app
