/// Gathers the data of all ranks on root over a tree of ranks, with bounded memory on every other rank.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/traffic.h"
#include "mpi/comm/communicator.h"

namespace pbmpi::mpi {

/// A tree of ranks with root 0, in which the descendants of a rank are numbered right after it without a gap
/// (a k-nomial tree: Thakur, Rabenseifner and Gropp, "Optimization of collective communication operations in
/// MPICH", IJHPCA 19, 2005, describe it with radix 2). To get the parent of a rank, write its number in the
/// radix and set its lowest nonzero digit to 0. A tree of no more ranks than its radix is flat: all are
/// children of root.
class RankTree {
 public:
  /// Root has at most 31 children a level, and 1,024 ranks have two levels (docs/scaling.md).
  static constexpr int usual_radix = 32;

  /// `num_ranks` >= 1, `radix` >= 2.
  explicit RankTree(int num_ranks, int radix = usual_radix);

  int num_ranks() const { return num_ranks_; }
  /// -1 for root.
  int parent(int rank) const;
  /// Ascending.
  std::vector<int> children(int rank) const;
  /// One past the last descendant of `rank`: the ranks from `rank` up to this one are `rank` and those below
  /// it.
  int end(int rank) const;
  /// Messages on the way from a rank to root; 0 for root.
  int depth(int rank) const;

 private:
  /// The place value of the lowest nonzero digit of `rank`; for root a power of the radix that no rank
  /// reaches.
  long long place(int rank) const;

  int num_ranks_;
  int radix_;
};

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
