/// Gathers the data of all ranks on root over a tree of ranks, with bounded memory on every other rank.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/traffic.h"
#include "mpi/comm/communicator.h"
#include "mpi/comm/rank_tree.h"

namespace pbmpi::mpi {

/// Gathers arrays whose lengths all ranks know. A rank hands on its own bytes and then those of each rank
/// below it, in order, in pieces of equal length: it holds at most two pieces that others sent, and root gets
/// the arrays in order of rank. In a flat tree each rank sends to root. The communicator is borrowed; calls
/// throw core::RunError as its calls do.
class TreeGather {
 public:
  static constexpr std::size_t usual_piece_bytes = std::size_t{1} << 20;

  explicit TreeGather(const Communicator& comm, int radix = RankTree::usual_radix,
                      std::size_t piece_bytes = usual_piece_bytes);

  /// [num_ranks] bytes of each rank; the same on every rank.
  void set_shares(std::span<const std::int64_t> bytes);
  /// Where a rank's bytes begin in the gathered array; begin(num_ranks) is where they end.
  std::int64_t begin(int rank) const { return begin_[static_cast<std::size_t>(rank)]; }
  std::int64_t total() const { return begin_.back(); }

  /// Collective. `own`: this rank's elements, as long as its share; `all` matters on root only, and has
  /// total() bytes.
  template <Sendable T>
  void gather(std::span<const T> own, std::span<T> all) {
    gather_bytes(std::as_bytes(own), std::as_writable_bytes(all));
  }

  /// Messages and bytes that this rank has sent since the last call.
  core::Traffic take_traffic();

 private:
  void gather_bytes(std::span<const std::byte> own, std::span<std::byte> all);
  /// Hands bytes on as soon as they fill a piece.
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

/// Collective. Gathers rows, of which each rank has any number: all of them by rank on root, none elsewhere.
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
