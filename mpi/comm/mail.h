/// Messages between two ranks that the sender need not wait for.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "core/traffic.h"
#include "mpi/comm/communicator.h"

namespace pbmpi::mpi {

/// Sends from buffers that it keeps until the messages have left. The communicator is borrowed. Every call
/// throws core::RunError with the name of the MPI call, MPI's message and the rank.
class Mail {
 public:
  explicit Mail(const Communicator& comm);
  ~Mail();
  Mail(const Mail&) = delete;
  Mail& operator=(const Mail&) = delete;

  /// Posts a message and returns at once.
  void post(std::vector<std::byte> message, int to, int tag);
  /// Waits for the next message of `from` with this tag, whatever its length.
  std::vector<std::byte> take(int from, int tag) const;
  /// Has a message of `from` with this tag arrived?
  bool has(int from, int tag) const;
  /// Waits until all posted messages have left.
  void finish();

  /// Messages and bytes posted since the last call.
  core::Traffic take_traffic();

 private:
  struct Posted;
  const Communicator* comm_;
  std::unique_ptr<Posted> posted_;
  core::Traffic traffic_;
};

}  // namespace pbmpi::mpi
