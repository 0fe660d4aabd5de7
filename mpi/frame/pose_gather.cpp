#include "mpi/frame/pose_gather.h"

#include <utility>

namespace pbmpi::mpi {
namespace {

constexpr int pose_tag = 2;

}  // namespace

PoseGather::PoseGather(const Communicator& comm, const stepping::WorldTable& table,
                       std::span<const int> placement, int radix)
    : comm_(&comm), table_(&table), tree_(comm, radix), messages_(comm) {
  if (comm.is_root()) gathered_.resize(table);
  set_placement(placement);
}

void PoseGather::set_placement(std::span<const int> placement) {
  if (comm_->is_root()) placement_.assign(placement.begin(), placement.end());
  tree_.set_shares(share_bytes(*table_, placement, comm_->size()));
  sent_.resize(begin(comm_->rank() + 1) - begin(comm_->rank()));
  if (comm_->is_root()) received_.resize(begin(comm_->size()));
}

void PoseGather::gather(std::span<const stepping::LocalWorld> worlds, std::span<const double> number) {
  put_own(worlds, number);
  if (comm_->size() == 1 || tree_.total() == 0) return;
  tree_.gather(std::span<const double>(sent_), std::span(received_));
  if (comm_->is_root()) unpack();
}

void PoseGather::expect() {
  if (!comm_->is_root()) return;
  for (int rank = 0; rank < comm_->size(); ++rank) {
    const std::span<double> share = std::span(received_).subspan(begin(rank), begin(rank + 1) - begin(rank));
    if (!share.empty()) messages_.receive(share, rank, pose_tag);
  }
}

void PoseGather::start(std::span<const stepping::LocalWorld> worlds, std::span<const double> number) {
  put_own(worlds, number);
  if (!comm_->is_root()) messages_.send(sent_, Communicator::root, pose_tag);
}

void PoseGather::deliver() {
  messages_.wait();
  if (comm_->is_root() && comm_->size() > 1) unpack();
}

void PoseGather::put_own(std::span<const stepping::LocalWorld> worlds, std::span<const double> number) {
  if (comm_->is_root()) {
    gathered_.copy(*table_, worlds, number);
  } else {
    pack_share(worlds, number, sent_.data());
  }
}

void PoseGather::unpack() {
  std::vector<std::size_t> next(static_cast<std::size_t>(comm_->size()));
  for (int rank = 0; rank < comm_->size(); ++rank) next[static_cast<std::size_t>(rank)] = begin(rank);
  gathered_.unpack(*table_, placement_, received_, std::move(next));
}

}  // namespace pbmpi::mpi
