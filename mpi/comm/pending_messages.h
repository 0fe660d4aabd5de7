/// Messages that travel while the ranks work.
#pragma once

#include <memory>
#include <span>

#include "mpi/comm/communicator.h"

namespace pbmpi::mpi {

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
