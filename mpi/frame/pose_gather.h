/// Brings the poses of all bodies, and a number of each world, to root.
#pragma once

#include <span>
#include <vector>

#include "core/vector.h"
#include "mpi/comm/communicator.h"
#include "mpi/comm/pending_messages.h"
#include "stepping/frame.h"

namespace pbmpi::mpi {

/// One MPI_Gatherv a frame into buffers that persist, or messages that travel while the ranks go on. Root
/// copies its own worlds without a message, and none is sent where all worlds are root's. The communicator
/// and the table are borrowed.
class PoseGather {
 public:
  PoseGather(const Communicator& comm, const stepping::WorldTable& table, std::span<const int> placement);

  /// After worlds have moved.
  void set_placement(std::span<const int> placement);

  /// Collective. `worlds`: this rank's, by ascending id; `number` [worlds.size()]: what else root is to know
  /// of each, as its cost.
  void gather(std::span<const stepping::LocalWorld> worlds, std::span<const double> number);

  /// Gathers without holding up the other ranks: root calls expect() before its own share, every rank calls
  /// start() with its share, root calls deliver() when it wants the poses, and the others call it before the
  /// next start(). Throws core::RunError on the rank whose message failed.
  void expect();
  void start(std::span<const stepping::LocalWorld> worlds, std::span<const double> number);
  void deliver();

  /// Result of the last gather() or deliver(), on root; empty elsewhere.
  std::span<const core::Vec3> position() const { return position_; }  ///< [num_bodies] m, (world, body) order
  std::span<const core::Quat> orientation() const { return orientation_; }  ///< [num_bodies] (w, x, y, z)
  std::span<const double> number() const { return number_; }                ///< [num_worlds]

 private:
  void pack(std::span<const stepping::LocalWorld> worlds, std::span<const double> number);
  void unpack();
  bool anything_travels() const { return layout_.displacements.back() + layout_.counts.back() > 0; }
  void copy_own(std::span<const stepping::LocalWorld> worlds, std::span<const double> number);

  const Communicator* comm_;
  const stepping::WorldTable* table_;
  std::vector<int> placement_;
  GatherLayout layout_;           ///< in doubles; root's own share is empty
  std::vector<double> sent_;      ///< per world: number, positions [n][3], orientations [n][4]
  std::vector<double> received_;  ///< root: the ranks' shares by rank
  std::vector<int> cursor_;       ///< [num_ranks] where the next world of a rank stands in received_
  std::vector<core::Vec3> position_;
  std::vector<core::Quat> orientation_;
  std::vector<double> number_;
  PendingMessages messages_;  ///< last member: cancels its messages before their memory is freed
};

}  // namespace pbmpi::mpi
