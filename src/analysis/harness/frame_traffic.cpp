#include "analysis/harness/frame_traffic.h"

#include <algorithm>
#include <bit>

#include "mpi/frame/pose_shares.h"

namespace pbmpi::analysis {
namespace {

std::int64_t pieces_of(std::int64_t bytes, std::int64_t piece_bytes) {
  return bytes / piece_bytes + (bytes % piece_bytes > 0 ? 1 : 0);
}

}  // namespace

std::int64_t bytes_of_world(std::int64_t num_bodies) {
  return static_cast<std::int64_t>(sizeof(double)) * mpi::numbers_of_world(num_bodies);
}

std::int64_t messages_of_allreduce(int num_ranks) {
  const auto power = static_cast<std::int64_t>(std::bit_floor(static_cast<unsigned>(num_ranks)));
  const std::int64_t rounds = std::bit_width(static_cast<unsigned>(power)) - 1;
  return power * rounds + 2 * (num_ranks - power);
}

int rounds_of_allreduce(int num_ranks) {
  const auto ranks = static_cast<unsigned>(num_ranks);
  return std::bit_width(ranks) - 1 + (std::has_single_bit(ranks) ? 0 : 2);
}

FrameTraffic frame_traffic(const HarnessLoad& load, const GatherShape& shape) {
  const mpi::RankTree tree(load.num_ranks, shape.radix);
  const std::int64_t bytes_each = bytes_of_world(load.bodies_each);
  FrameTraffic traffic;
  // Worlds of a range of ranks, excluding root, which does not send its own.
  const auto worlds_before = [&](std::int64_t rank) {
    const std::int64_t more = load.num_worlds % load.num_ranks;
    return load.num_worlds / load.num_ranks * rank + std::min(rank, more);
  };
  for (int rank = 1; rank < load.num_ranks; ++rank) {
    const std::int64_t bytes = bytes_each * (worlds_before(tree.end(rank)) - worlds_before(rank));
    const core::Traffic sent{pieces_of(bytes, shape.piece_bytes), bytes};
    traffic.gather.messages += sent.messages;
    traffic.gather.bytes += sent.bytes;
    if (sent.bytes > traffic.busiest_rank.bytes) traffic.busiest_rank = sent;
    if (tree.parent(rank) != 0) continue;
    traffic.into_root.messages += sent.messages;
    traffic.into_root.bytes += sent.bytes;
  }
  traffic.agreement.messages = messages_of_allreduce(load.num_ranks);
  traffic.agreement.bytes = bytes_of_agreement * traffic.agreement.messages;
  traffic.verdict.messages = load.num_ranks - 1;  // with any tree
  traffic.verdict.bytes = bytes_of_verdict * traffic.verdict.messages;
  return traffic;
}

}  // namespace pbmpi::analysis
