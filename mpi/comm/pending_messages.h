/// Messages that travel while the ranks work.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "core/traffic.h"
#include "mpi/comm/communicator.h"

namespace pbmpi::mpi {

/// Messages between two ranks that the sender need not wait for: sends from buffers that it keeps until they
/// have left. The communicator is borrowed. Every call
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

/// Non-blocking messages of one rank. The memory that they use must stay valid until wait(). The communicator
/// is borrowed.
///
/// A message is sent in pieces of 3.5 KiB: MPI sends such short messages at once ("eagerly"), while a longer
/// one waits until both ranks are inside MPI, and a rank that computes is not. Sender and receiver must give
/// the same length.
class PendingMessages {
 public:
  explicit PendingMessages(const Communicator& comm);
  /// Cancels messages that have not arrived: nobody waits while an error unwinds.
  ~PendingMessages();
  PendingMessages(const PendingMessages&) = delete;
  PendingMessages& operator=(const PendingMessages&) = delete;

  void send(std::span<const double> values, int to, int tag);
  void receive(std::span<double> values, int from, int tag);
  /// Waits until all messages are done. Throws core::RunError if one failed.
  void wait();

 private:
  struct Requests;
  const Communicator* comm_;
  std::unique_ptr<Requests> requests_;
};

}  // namespace pbmpi::mpi
