#include "mpi/comm/tree_gather.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "core/error.h"

namespace pbmpi::mpi {
namespace {

constexpr int gather_tag = 3;

}  // namespace

RankTree::RankTree(int num_ranks, int radix) : num_ranks_(num_ranks), radix_(radix) {
  core::require_invariant(num_ranks >= 1 && radix >= 2, "RankTree: num_ranks >= 1, radix >= 2");
}

long long RankTree::place(int rank) const {
  long long place = 1;
  if (rank == 0) {
    while (place < num_ranks_) place *= radix_;
    return place;
  }
  while (rank / place % radix_ == 0) place *= radix_;
  return place;
}

int RankTree::parent(int rank) const {
  if (rank == 0) return -1;
  const long long digit = place(rank);
  return static_cast<int>(rank - rank / digit % radix_ * digit);
}

std::vector<int> RankTree::children(int rank) const {
  std::vector<int> children;
  for (long long digit = 1; digit < place(rank); digit *= radix_) {
    for (int times = 1; times < radix_ && rank + times * digit < num_ranks_; ++times)
      children.push_back(static_cast<int>(rank + times * digit));
  }
  return children;
}

int RankTree::end(int rank) const {
  return static_cast<int>(std::min<long long>(rank + place(rank), num_ranks_));
}

int RankTree::depth(int rank) const {
  int depth = 0;
  for (; rank != 0; rank = parent(rank)) ++depth;
  return depth;
}

TreeGather::TreeGather(const Communicator& comm, int radix, std::size_t piece_bytes)
    : comm_(&comm),
      tree_(comm.size(), radix),
      children_(tree_.children(comm.rank())),
      piece_bytes_(piece_bytes),
      begin_(static_cast<std::size_t>(comm.size()) + 1, 0) {
  core::require_invariant(piece_bytes > 0, "TreeGather: a piece has a length");
}

void TreeGather::set_shares(std::span<const std::int64_t> bytes) {
  core::require_invariant(bytes.size() + 1 == begin_.size(), "TreeGather: a share for each rank");
  for (std::size_t rank = 0; rank < bytes.size(); ++rank) begin_[rank + 1] = begin_[rank] + bytes[rank];
}

void TreeGather::gather_bytes(std::span<const std::byte> own, std::span<std::byte> all) {
  const int rank = comm_->rank();
  core::require_invariant(std::cmp_equal(own.size(), begin(rank + 1) - begin(rank)),
                          "TreeGather: a rank sends as much as its share");
  if (comm_->is_root()) {
    core::require_invariant(std::cmp_equal(all.size(), total()), "TreeGather: root has room for all shares");
    if (!own.empty()) std::memcpy(all.data(), own.data(), own.size());
  } else if (children_.empty()) {
    for (; !own.empty(); own = own.subspan(std::min(own.size(), piece_bytes_)))
      send(own.first(std::min(own.size(), piece_bytes_)));
  } else {
    hand_on(own);
  }
  for (const int child : children_) {
    auto left = static_cast<std::size_t>(bytes_below(child));
    auto next = static_cast<std::size_t>(begin(child));
    while (left > 0) {
      const std::size_t bytes = std::min(left, piece_bytes_);
      if (comm_->is_root()) {
        comm_->recv(all.subspan(next, bytes), child, gather_tag);
      } else {
        arriving_.resize(bytes);
        comm_->recv(std::span(arriving_), child, gather_tag);
        hand_on(arriving_);
      }
      next += bytes;
      left -= bytes;
    }
  }
  if (leaving_.empty()) return;
  send(leaving_);
  leaving_.clear();
}

/// What this rank hands on is cut at multiples of the piece length, which its parent relies on.
void TreeGather::hand_on(std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    if (leaving_.empty() && bytes.size() >= piece_bytes_) {
      send(bytes.first(piece_bytes_));
      bytes = bytes.subspan(piece_bytes_);
      continue;
    }
    const std::size_t taken = std::min(bytes.size(), piece_bytes_ - leaving_.size());
    leaving_.insert(leaving_.end(), bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(taken));
    bytes = bytes.subspan(taken);
    if (leaving_.size() < piece_bytes_) continue;
    send(leaving_);
    leaving_.clear();
  }
}

void TreeGather::send(std::span<const std::byte> piece) {
  comm_->send(piece, tree_.parent(comm_->rank()), gather_tag);
  ++traffic_.messages;
  traffic_.bytes += static_cast<std::int64_t>(piece.size());
}

core::Traffic TreeGather::take_traffic() { return std::exchange(traffic_, {}); }

}  // namespace pbmpi::mpi
