#include "mpi/comm/pending_messages.h"

#include <gtest/gtest.h>

#include <numeric>
#include <vector>

namespace pbmpi::mpi {
namespace {

// Pieces have 448 values: these are less than one piece, whole pieces, and one value more.
constexpr int lengths[] = {1, 447, 448, 449, 3 * 448, 10'000};

std::vector<double> message(int length, int from) {
  std::vector<double> values(static_cast<std::size_t>(length));
  std::iota(values.begin(), values.end(), 1e6 * from);
  return values;
}

TEST(PendingMessages, every_piece_arrives_in_its_place) {
  const Communicator comm = Communicator::world();
  for (const int length : lengths) {
    PendingMessages pending(comm);
    std::vector<std::vector<double>> received(comm.size(), std::vector<double>(length, -1));
    const std::vector<double> mine = message(length, comm.rank());
    for (int rank = 0; rank < comm.size(); ++rank) {
      if (rank != comm.rank()) pending.receive(received[rank], rank, 7);
    }
    for (int rank = 0; rank < comm.size(); ++rank) {
      if (rank != comm.rank()) pending.send(mine, rank, 7);
    }
    pending.wait();
    for (int rank = 0; rank < comm.size(); ++rank) {
      if (rank == comm.rank()) continue;
      EXPECT_EQ(received[rank], message(length, rank));
    }
  }
}

TEST(PendingMessages, a_frame_of_poses_leaves_before_the_receiver_asks_for_it) {
  // Root receives after a barrier that the sender reaches after wait(): if the messages were not sent at
  // once, the test would hang.
  const Communicator comm = Communicator::world();
  const int length = 7 * 185;  // five worlds of CrashSk
  PendingMessages pending(comm);
  const std::vector<double> mine = message(length, comm.rank());
  std::vector<double> received(length);
  if (comm.rank() == 1) {
    pending.send(mine, 0, 3);
    pending.wait();
  }
  comm.barrier();
  if (comm.rank() == 0) {
    pending.receive(received, 1, 3);
    pending.wait();
    EXPECT_EQ(received, message(length, 1));
  }
}

TEST(PendingMessages, those_given_up_leave_the_communicator_usable) {
  const Communicator comm = Communicator::world().dup();
  std::vector<double> never(100);
  {
    PendingMessages pending(comm);
    if (comm.is_root()) pending.receive(never, 1, 9);  // nobody sends this
  }
  double value = comm.is_root() ? 42 : 0;
  comm.bcast_value(value);
  EXPECT_EQ(value, 42);
}

}  // namespace
}  // namespace pbmpi::mpi
