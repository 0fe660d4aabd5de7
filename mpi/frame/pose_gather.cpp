#include "mpi/frame/pose_gather.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "mpi/comm/communicator.h"

namespace pbmpi::mpi {
namespace {

constexpr int pose_tag = 2;

}  // namespace

std::vector<std::int64_t> share_bytes(const stepping::WorldTable& table, std::span<const int> placement,
                                      int num_ranks) {
  std::vector<std::int64_t> bytes(static_cast<std::size_t>(num_ranks), 0);
  for (int world = 0; world < table.num_worlds(); ++world) {
    if (placement[world] == Communicator::root) continue;
    bytes[placement[world]] += static_cast<std::int64_t>(sizeof(double)) *
                               numbers_of_world(table.body_offset[world + 1] - table.body_offset[world]);
  }
  return bytes;
}

void pack_share(std::span<const stepping::LocalWorld> worlds, std::span<const double> number, double* to) {
  for (std::size_t i = 0; i < worlds.size(); ++i) {
    const model::State& state = *worlds[i].state;
    const std::size_t num_bodies = state.position.size();
    *to++ = number[i];
    if (num_bodies == 0) continue;
    std::memcpy(to, state.position.front().data(), 3 * num_bodies * sizeof(double));
    to += 3 * num_bodies;
    std::memcpy(to, &state.orientation.front().w, 4 * num_bodies * sizeof(double));
    to += 4 * num_bodies;
  }
}

void GatheredPoses::resize(const stepping::WorldTable& table) {
  position.resize(static_cast<std::size_t>(table.num_bodies()));
  orientation.resize(position.size());
  number.resize(static_cast<std::size_t>(table.num_worlds()));
}

void GatheredPoses::copy(const stepping::WorldTable& table, std::span<const stepping::LocalWorld> worlds,
                         std::span<const double> numbers) {
  for (std::size_t i = 0; i < worlds.size(); ++i) {
    const model::State& state = *worlds[i].state;
    const std::int64_t first = table.body_offset[worlds[i].id];
    std::copy(state.position.begin(), state.position.end(), position.begin() + first);
    std::copy(state.orientation.begin(), state.orientation.end(), orientation.begin() + first);
    number[worlds[i].id] = numbers[i];
  }
}

void GatheredPoses::unpack(const stepping::WorldTable& table, std::span<const int> placement,
                           std::span<const double> received, std::vector<std::size_t> next) {
  for (int world = 0; world < table.num_worlds(); ++world) {
    const int owner = placement[world];
    if (owner == Communicator::root) continue;
    const std::int64_t first = table.body_offset[world];
    const std::int64_t num_bodies = table.body_offset[world + 1] - first;
    const double* from = received.data() + next[owner];
    number[world] = *from++;
    if (num_bodies > 0) {
      const auto count = static_cast<std::size_t>(num_bodies);
      std::memcpy(position[first].data(), from, 3 * count * sizeof(double));
      std::memcpy(&orientation[first].w, from + 3 * count, 4 * count * sizeof(double));
    }
    next[owner] += static_cast<std::size_t>(numbers_of_world(num_bodies));
  }
}

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
