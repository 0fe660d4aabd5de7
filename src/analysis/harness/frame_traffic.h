/// Messages and bytes of a frame in which each rank owns whole worlds: counted, not measured.
#pragma once

#include <cstdint>

#include "analysis/harness/harness_load.h"
#include "core/traffic.h"

namespace pbmpi::analysis {

/// Messages and bytes sent in a frame without output, estimate, rebalance or checkpoint.
struct FrameTraffic {
  core::Traffic gather;        ///< poses and costs: sent by all ranks
  core::Traffic into_root;     ///< the part of it that root receives
  core::Traffic busiest_rank;  ///< sent by the rank, other than root, that sends the most bytes
  core::Traffic agreement;     ///< the allreduce of the frame: sent by all ranks
  core::Traffic verdict;       ///< the bcast of the frame

  core::Traffic all() const {
    return {gather.messages + agreement.messages + verdict.messages,
            gather.bytes + agreement.bytes + verdict.bytes};
  }
};

FrameTraffic frame_traffic(const HarnessLoad& load, const GatherShape& shape = {});

/// Messages of a small allreduce by recursive doubling (Thakur, Rabenseifner and Gropp 2005, section 4.5,
/// which Open MPI's component "tuned" uses): with a power of two P of ranks each sends log2 P; the ranks
/// beyond the power of two first give their values to a neighbour, and get the result from it at the end.
std::int64_t messages_of_allreduce(int num_ranks);
/// Rounds of this allreduce, one after the other.
int rounds_of_allreduce(int num_ranks);

/// Bytes that are sent to root in a frame for one world.
std::int64_t bytes_of_world(std::int64_t num_bodies);

inline constexpr std::int64_t bytes_of_agreement = 6 * 8;  ///< mpi::FrameDriver::agree_on_status()
inline constexpr std::int64_t bytes_of_verdict = 32;       ///< mpi::FrameDriver::Verdict

}  // namespace pbmpi::analysis
