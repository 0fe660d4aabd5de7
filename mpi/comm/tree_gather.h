/// Brings the data of all ranks to root over a tree of ranks, in bounded memory everywhere else.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/traffic.h"
#include "mpi/comm/communicator.h"
#include "mpi/comm/rank_tree.h"

namespace pbmpi::mpi {

/// Gathers arrays whose lengths all ranks know. A rank hands on its own bytes, then those of each rank below
/// it in their order, in pieces of equal length: it holds no more than two pieces of what others sent, and
/// root gets the arrays one rank's after the other's. In a flat tree each rank sends to root. The
/// communicator is borrowed; calls throw core::RunError as its own do.
class TreeGather {
 public:
  static constexpr std::size_t usual_piece_bytes = std::size_t{1} << 20;

  explicit TreeGather(const Communicator& comm, int radix = RankTree::usual_radix,
                      std::size_t piece_bytes = usual_piece_bytes);

  /// [num_ranks] bytes that each rank has; the same on every rank.
  void set_shares(std::span<const std::int64_t> bytes);
  /// Where a rank's bytes begin in the gathered array; of num_ranks where they end.
  std::int64_t begin(int rank) const { return begin_[static_cast<std::size_t>(rank)]; }
  std::int64_t total() const { return begin_.back(); }

  /// Collective. `own`: of this rank, as long as its share; `all` counts on root only, and has total() bytes.
  template <Sendable T>
  void gather(std::span<const T> own, std::span<T> all) {
    gather_bytes(std::as_bytes(own), std::as_writable_bytes(all));
  }

  /// What this rank has sent since the last call.
  core::Traffic take_traffic();

 private:
  void gather_bytes(std::span<const std::byte> own, std::span<std::byte> all);
  /// Hands bytes on, as soon as a piece of them is there.
  void hand_on(std::span<const std::byte> bytes);
  void send(std::span<const std::byte> piece);
  std::int64_t bytes_below(int rank) const { return begin(tree_.end(rank)) - begin(rank); }

  const Communicator* comm_;
  RankTree tree_;
  std::vector<int> children_;  ///< of this rank
  std::size_t piece_bytes_;
  std::vector<std::int64_t> begin_;            ///< [num_ranks + 1]
  std::vector<std::byte> arriving_, leaving_;  ///< a piece at most
  core::Traffic traffic_;
};

/// Collective. Gathers rows of which each rank has any number: all of them on root, by rank; nothing
/// elsewhere.
template <Sendable Row>
std::vector<Row> gather_rows(const Communicator& comm, std::span<const Row> own) {
  std::vector<std::int64_t> bytes = comm.allgather(static_cast<std::int64_t>(own.size_bytes()));
  TreeGather gather(comm);
  gather.set_shares(bytes);
  std::vector<Row> all;
  if (comm.is_root()) all.resize(static_cast<std::size_t>(gather.total()) / sizeof(Row));
  gather.gather(own, std::span<Row>(all));
  return all;
}

}  // namespace pbmpi::mpi
