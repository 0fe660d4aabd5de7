/// Brings the poses of all bodies, and one number per world, to root.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/vector.h"
#include "mpi/comm/communicator.h"
#include "mpi/comm/pending_messages.h"
#include "mpi/comm/tree_gather.h"
#include "stepping/frame.h"

namespace pbmpi::mpi {

/// Numbers that are sent for a world: its own number, positions [n][3], orientations [n][4] (w, x, y, z).
constexpr std::int64_t numbers_of_world(std::int64_t num_bodies) { return 1 + 7 * num_bodies; }

/// [num_ranks] bytes that each rank sends; root sends none.
std::vector<std::int64_t> share_bytes(const stepping::WorldTable& table, std::span<const int> placement,
                                      int num_ranks);

/// Writes the share of a rank with these worlds, by ascending id; `number` [worlds.size()].
void pack_share(std::span<const stepping::LocalWorld> worlds, std::span<const double> number, double* to);

/// Poses and numbers of all worlds on root.
struct GatheredPoses {
  std::vector<core::Vec3> position;     ///< [num_bodies] m, (world, body) order
  std::vector<core::Quat> orientation;  ///< [num_bodies] (w, x, y, z)
  std::vector<double> number;           ///< [num_worlds]

  void resize(const stepping::WorldTable& table);
  /// Copies root's own worlds.
  void copy(const stepping::WorldTable& table, std::span<const stepping::LocalWorld> worlds,
            std::span<const double> numbers);
  /// Unpacks the worlds of the other ranks. `received`: their shares by rank; `next` [num_ranks] where each
  /// begins.
  void unpack(const stepping::WorldTable& table, std::span<const int> placement,
              std::span<const double> received, std::vector<std::size_t> next);
};

/// Gathers poses in one of two ways: over a tree of ranks each frame, into buffers that persist, or by
/// messages straight to root that travel while the ranks go on. Root copies its own worlds without a message,
/// and nothing is sent where root owns all worlds. The communicator and the table are borrowed.
class PoseGather {
 public:
  /// `radix`: the radix of the tree.
  PoseGather(const Communicator& comm, const stepping::WorldTable& table, std::span<const int> placement,
             int radix = RankTree::usual_radix);

  /// To be called after worlds have moved.
  void set_placement(std::span<const int> placement);

  /// Collective. `worlds`: this rank's, by ascending id; `number` [worlds.size()]: one more number of each
  /// for root, such as its cost.
  void gather(std::span<const stepping::LocalWorld> worlds, std::span<const double> number);

  /// Gathers without holding up the other ranks: root calls expect() before its own share, every rank calls
  /// start() with its share, root calls deliver() when it wants the poses, and the others call deliver()
  /// before the next start(). Throws core::RunError on the rank whose message failed.
  void expect();
  void start(std::span<const stepping::LocalWorld> worlds, std::span<const double> number);
  void deliver();

  /// Result of the last gather() or deliver(), on root; empty elsewhere.
  std::span<const core::Vec3> position() const { return gathered_.position; }
  std::span<const core::Quat> orientation() const { return gathered_.orientation; }
  std::span<const double> number() const { return gathered_.number; }

  /// Messages and bytes that gather() has sent since the last call.
  core::Traffic take_traffic() { return tree_.take_traffic(); }

 private:
  void unpack();
  void put_own(std::span<const stepping::LocalWorld> worlds, std::span<const double> number);
  /// Where a rank's share begins in received_; root's own is empty.
  std::size_t begin(int rank) const { return static_cast<std::size_t>(tree_.begin(rank)) / sizeof(double); }

  const Communicator* comm_;
  const stepping::WorldTable* table_;
  std::vector<int> placement_;  ///< used on root
  TreeGather tree_;
  std::vector<double> sent_;      ///< the share of this rank
  std::vector<double> received_;  ///< on root: the ranks' shares by rank
  GatheredPoses gathered_;        ///< on root
  PendingMessages messages_;      ///< last member: cancels its messages before their memory is freed
};

}  // namespace pbmpi::mpi
