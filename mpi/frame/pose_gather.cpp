#include "mpi/frame/pose_gather.h"

#include <algorithm>
#include <cstring>

namespace pbmpi::mpi {
namespace {

constexpr std::size_t doubles_per_body = 7;
constexpr int pose_tag = 2;

std::size_t share_of_world(std::int64_t num_bodies) { return 1 + doubles_per_body * num_bodies; }

}  // namespace

PoseGather::PoseGather(const Communicator& comm, const stepping::WorldTable& table,
                       std::span<const int> placement)
    : comm_(&comm), table_(&table), messages_(comm) {
  if (comm.is_root()) {
    position_.resize(table.num_bodies());
    orientation_.resize(table.num_bodies());
    number_.resize(table.num_worlds());
  }
  set_placement(placement);
}

void PoseGather::set_placement(std::span<const int> placement) {
  placement_.assign(placement.begin(), placement.end());
  std::vector<std::int64_t> share(comm_->size(), 0);
  for (int world = 0; world < table_->num_worlds(); ++world) {
    if (placement[world] == Communicator::root) continue;
    share[placement[world]] += share_of_world(table_->body_offset[world + 1] - table_->body_offset[world]);
  }
  layout_ = GatherLayout::packed(share);
  sent_.resize(share[comm_->rank()]);
  if (comm_->is_root()) received_.resize(layout_.displacements.back() + layout_.counts.back());
}

void PoseGather::gather(std::span<const stepping::LocalWorld> worlds, std::span<const double> number) {
  if (comm_->is_root()) {
    copy_own(worlds, number);
  } else {
    pack(worlds, number);
  }
  if (comm_->size() == 1 || !anything_travels()) return;
  comm_->gatherv(std::span<const double>(sent_), std::span(received_), layout_);
  if (comm_->is_root()) unpack();
}

void PoseGather::expect() {
  if (!comm_->is_root()) return;
  for (int rank = 0; rank < comm_->size(); ++rank) {
    const std::span<double> share =
        std::span(received_).subspan(static_cast<std::size_t>(layout_.displacements[rank]),
                                     static_cast<std::size_t>(layout_.counts[rank]));
    if (!share.empty()) messages_.receive(share, rank, pose_tag);
  }
}

void PoseGather::start(std::span<const stepping::LocalWorld> worlds, std::span<const double> number) {
  if (comm_->is_root()) {
    copy_own(worlds, number);
  } else {
    pack(worlds, number);
    messages_.send(sent_, Communicator::root, pose_tag);
  }
}

void PoseGather::deliver() {
  messages_.wait();
  if (comm_->is_root() && comm_->size() > 1) unpack();
}

void PoseGather::pack(std::span<const stepping::LocalWorld> worlds, std::span<const double> number) {
  double* to = sent_.data();
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

void PoseGather::unpack() {
  cursor_ = layout_.displacements;
  for (int world = 0; world < table_->num_worlds(); ++world) {
    const int owner = placement_[world];
    if (owner == Communicator::root) continue;
    const std::int64_t first = table_->body_offset[world];
    const std::size_t num_bodies = table_->body_offset[world + 1] - first;
    const double* from = received_.data() + cursor_[owner];
    number_[world] = *from++;
    if (num_bodies > 0) {
      std::memcpy(position_[first].data(), from, 3 * num_bodies * sizeof(double));
      std::memcpy(&orientation_[first].w, from + 3 * num_bodies, 4 * num_bodies * sizeof(double));
    }
    cursor_[owner] += static_cast<int>(share_of_world(num_bodies));
  }
}

void PoseGather::copy_own(std::span<const stepping::LocalWorld> worlds, std::span<const double> number) {
  for (std::size_t i = 0; i < worlds.size(); ++i) {
    const model::State& state = *worlds[i].state;
    const std::int64_t first = table_->body_offset[worlds[i].id];
    std::copy(state.position.begin(), state.position.end(), position_.begin() + first);
    std::copy(state.orientation.begin(), state.orientation.end(), orientation_.begin() + first);
    number_[worlds[i].id] = number[i];
  }
}

}  // namespace pbmpi::mpi
